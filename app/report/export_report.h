// What export tells at its end: warnings and a table for people, one JSON document for programs.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/project/export_pieces.h"

namespace qchopper {

// Of pieces that keep more faces than were asked for.
std::vector<std::string> warnings(const ExportedProject& exported, const ExportRequest& request);
std::vector<std::string> lines(const ExportedProject& exported, const Project& project);
// `folder`: the project as it was named.
std::string document(const ExportedProject& exported, const ExportRequest& request, const Project& project,
                     const std::filesystem::path& folder);

}  // namespace qchopper
