// Writes pieces of a project as files for other programs, in place or in setup pose, simplified on request
// (docs/user/export.md, tests/app/cli/export_test.cpp). Lengths in mm.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/open_project.h"
#include "cam/export/export.h"
#include "segment/simplify/simplify.h"

namespace qchopper {

constexpr double max_distance_share = 0.01;

struct ExportRequest {
    std::string format;                        // 3mf | stl | ply | glb
    std::string pose = "place";                // place | setup
    std::optional<std::string> piece;          // nothing: all
    std::optional<double> simplify_mm;         // largest deviation, above 0; excludes max_faces
    std::optional<std::size_t> max_faces;      // of a piece, at least 4
    std::optional<double> max_distance_mm;     // with max_faces; nothing: max_distance_share of the piece's diagonal
    bool holes = false;                        // cut the holes of the dowels in; excludes simplifying
    std::optional<std::filesystem::path> out;  // a file or a folder; nothing: beside the project
};

struct ExportedPiece {
    ExportPiece piece;
    SimplifyReport simplified;  // default where nothing is simplified
    std::filesystem::path file;
};

struct ExportedProject {
    std::filesystem::path out;  // the file, or the folder of the files
    bool is_simplified = false;
    std::vector<ExportedPiece> pieces;
    bool is_demand_met() const;  // no piece keeps more faces than max_faces
};

// A file or folder appears whole or not at all. Precondition: format and pose are values of the lists above. Throws
// InputError: (use) options that exclude each other, no such piece, setup pose without a cell, a name without the
// ending of the format, a piece that max_faces moves by more than max_distance_mm or lets run through itself; (create)
// the output exists or cannot be made; (mesh) piece files that are not those of the project. Throws Cancelled.
ExportedProject export_pieces(OpenProject& project, const ExportRequest& request, const std::string& program_version,
                              const Context& context);

}  // namespace qchopper
