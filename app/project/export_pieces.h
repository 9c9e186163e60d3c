// Writes pieces of a project as files for other programs, in place or as they lie in their stock, simplified where
// asked. docs/export.md tells it to operators.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/project/open_project.h"
#include "cam/export/export.h"
#include "segment/simplify/simplify.h"

namespace qchopper {

struct ExportRequest {
    std::string format;          // 3mf | stl | ply | glb
    std::string pose = "place";  // place | setup
    std::optional<std::string> piece;
    std::optional<double> simplify_mm;
    std::optional<std::size_t> max_faces;
    std::optional<std::filesystem::path> out;
};

struct ExportedPiece {
    ExportPiece piece;
    SimplifyReport simplified;
    std::filesystem::path file;
};

struct ExportedProject {
    std::filesystem::path out;  // the file, or the folder of the files
    bool is_simplified = false;
    std::vector<ExportedPiece> pieces;
    bool is_demand_met() const;  // no piece keeps more faces than were asked for
};

// A file or folder appears whole or not at all. Throws InputError: (use) what does not go together or is not in the
// project, (create) something is there already, (mesh) pieces that are not those of the project.
ExportedProject export_pieces(OpenProject& project, const ExportRequest& request, const std::string& program_version,
                              const Context& context);

}  // namespace qchopper
