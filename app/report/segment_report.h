// What segment answers: a few lines or a table for people, one JSON document for programs.

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/project/decide.h"
#include "app/project/project.h"

namespace qchopper {

// What was discarded, in the same words and keys in every report:
// "discarded after cut 2: piece C, 1,234 faces, 12.345 ml (3.21 % of the scan)", none if nothing is discarded;
// [ { name, after, cut, faces, volume_mm3 } ... ], after so many cuts, made by cut, 0 for the scan.
std::vector<std::string> discarded_lines(const Project& project);
nlohmann::ordered_json discarded_json(const Project& project);

std::vector<std::string> lines(const SegmentAnswer& answer, const std::filesystem::path& folder,
                               const Project& project);
std::string document(const SegmentAnswer& answer, const std::filesystem::path& folder, const Project& project);

}  // namespace qchopper
