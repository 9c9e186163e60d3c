// The result of export: warnings and a table for people, one JSON document for programs. O(pieces).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/export_pieces.h"
#include "app/report/document.h"

namespace qchopper {

// What of the project is not exported, where not one piece alone was asked for; then one per piece that keeps more
// faces than request.max_faces, and per piece that took the slower way (simplify.h).
std::vector<std::string> warnings(const ExportedProject& exported, const ExportRequest& request,
                                  const Project& project);
std::vector<std::string> lines(const ExportedProject& exported, const Project& project);
// The document qchopper-export-1 (docs/user/export.md); `folder` is the project folder as it was typed.
Document document(const ExportedProject& exported, const ExportRequest& request, const Project& project,
                  const std::filesystem::path& folder);

}  // namespace qchopper
