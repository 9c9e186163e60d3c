// Writes pieces as files for other programs, in the coordinates of the scan or as they lie in their stock.
//
// Millimetres; in GLB the root node converts to metres. 3MF holds the mesh of a piece unchanged and its pose beside it;
// GLB, STL and PLY hold the points in the pose, GLB about the middle of each piece. Same pieces, same bytes
// (tests/app/cli/export_test.cpp). docs/user/export.md describes the files for operators.

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file.h"
#include "base/pose.h"
#include "base/sha256.h"
#include "segment/cut/piece.h"
#include "segment/io/write_glb.h"

namespace qchopper {

enum class ExportFormat { threemf, stl, ply, glb };

// "3mf", "stl", "ply" or "glb"; it is also the ending of the file. Throws InputError (use) for anything else.
ExportFormat export_format_named(std::string_view name);
// Whether one file holds all pieces, as 3MF and GLB do; STL and PLY hold one piece each.
bool holds_many(ExportFormat format);

struct ExportPiece {
    std::string name;
    std::shared_ptr<const TriangleMesh> mesh;        // in piece coordinates; never null
    Pose pose;                                       // from piece coordinates to those of the file
    std::int32_t step = 0;                           // number of the cut that made it; 0: none
    std::string parent;                              // the piece that it was cut from; empty: none
    std::optional<bool> fits;                        // into its cell; nothing: not checked
    std::array<double, 3> colour{0.80, 0.72, 0.56};  // linear red, green, blue
    std::vector<GlbKey> moves = {};                  // of the assembly, in GLB only
};

struct ExportNotes {
    std::string title;  // of the project
    std::string program_version;
    Sha256 scan_sha256;
    Vec3 centre;  // mm: what was subtracted from the scan's points
};

// Shifts the poses so that the pieces stand in a row along x from x = 0 on, `gap` mm between their boxes.
void stand_in_a_row(std::span<ExportPiece> pieces, double gap);

// All pieces as one file. Precondition: the format is 3MF or GLB. Throws InputError (use) for a GLB beyond 4 GiB.
Bytes export_file(ExportFormat format, std::span<const ExportPiece> pieces, const ExportNotes& notes);

// One piece. Precondition: the format is STL or PLY.
Bytes export_file(ExportFormat format, const ExportPiece& piece);

}  // namespace qchopper
