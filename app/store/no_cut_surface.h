// Surface of a scan that must not be cut: no candidate goes through a face with a marked vertex.
//
// It is decided once, when the project is made, and kept in its folder as the marked points of the imported scan (three
// doubles each), bound by a SHA-256 in project.json. So the project opens without the painted file
// (tests/app/store/no_cut_surface_test.cpp).

#pragma once

#include <filesystem>
#include <optional>

#include "app/store/project_context.h"
#include "app/store/project_scan.h"
#include "base/files/file.h"
#include "segment/io/read_painted.h"

namespace qchopper {

// The name of that file in the project folder.
constexpr const char* no_cut_file = "no_cut.bin";

struct NoCutMarks {
    MarkedPoints points;  // in the unit of their file
    Sha256 sha256;        // of the file
};

// The file that choices.no_cut names; nothing if it names none. Throws what read_file and parse_no_cut_ply throw.
std::optional<NoCutMarks> read_no_cut(const ProjectChoices& choices);

// The marked points of the imported scan, put in `settings`, and the record of them; nothing, and a warning is added to
// the import's, if nothing is marked. `marks` is what read_no_cut returns; in units, scale and place it is taken as the
// scan. Throws InputError (mesh) for a file of another surface, as ignore_surface does.
std::optional<NoCutSurface> mark_no_cut(const ProjectChoices& choices, std::optional<NoCutMarks> marks,
                                        ImportedScan& imported, CandidateOptions& options, const Context& context);

// What is written in the folder: in the byte order of the machine. Empty if nothing is marked.
Bytes no_cut_bytes(const NoCut& no_cut);

// The points of a project on disk. Throws InputError (config) if the file in the folder is missing or is not the one
// that was written.
NoCut load_no_cut(const std::filesystem::path& folder, const NoCutSurface& record);

}  // namespace qchopper
