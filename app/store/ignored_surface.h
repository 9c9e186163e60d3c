// Surface of a scan that may stay as it is, because the operator painted it or because it lies inside: it takes no part
// in what is out of reach, but still hides other surface.
//
// It is decided once, when the project is made, and kept in its folder as one byte per triangle of the imported scan
// (1: ignored), bound by a SHA-256 in project.json. So the project opens without the painted file and without new rays
// (tests/app/store/ignored_surface_test.cpp).

#pragma once

#include <filesystem>
#include <optional>

#include "app/store/project_context.h"
#include "app/store/project_scan.h"

namespace qchopper {

// The name of that file in the project folder.
constexpr const char* ignored_file = "ignored.bin";

struct PaintedScan {
    TriangleMesh mesh;  // in the unit of its file; TriangleMesh::ignored is what is painted
    Sha256 sha256;      // of the file
};

// The file that choices.ignore names; nothing if it names none. Throws what read_file and parse_painted_ply throw.
std::optional<PaintedScan> read_painted(const ProjectChoices& choices);

// Fills TriangleMesh::ignored of the imported scan; nothing is filled, and a warning is added to the import's, if no
// surface is ignored. `painted` is what read_painted returns; in units, scale and place it is taken as the scan.
// Throws InputError (mesh) for a painted file of another surface: more than a hundredth of its area is farther from the
// scan than half a hundredth of the scan's diagonal, and it is not the scan's own file; and where less than a
// thousandth of the surface would be left. Throws Cancelled.
std::optional<IgnoredSurface> ignore_surface(const ProjectChoices& choices, std::optional<PaintedScan> painted,
                                             ImportedScan& imported, const Context& context);

// The imported scan of a project on disk, with what is ignored of it. Throws what import_project_scan throws, and
// InputError (config) if the file in the folder is missing or is not the one that was written.
TriangleMesh scan_of_project(const std::filesystem::path& folder, const Project& project, const Context& context);

}  // namespace qchopper
