// What segment answers: a few lines or a table for people, one JSON document for programs.

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "app/report/outline.h"

namespace qchopper {

// The ranking of one piece.
struct Proposal {
    std::string piece;
    std::size_t faces = 0;
    bool rules_hold = false;
    std::vector<Ranked> ranked;         // all
    std::size_t top = 10;               // so many are shown
    std::vector<std::size_t> crossing;  // of those shown, the places (from 1) of planes whose sections cross
};

// What one plane would make.
struct Preview {
    std::string piece;
    Ranked plane;
    Outline outline;
    std::vector<SolidPrice> solids;
    bool sections_cross = false;  // the piece runs through itself in this plane
};

struct SegmentAnswer {
    std::string done;                // the decision in words; empty: none was made
    std::vector<std::string> notes;  // whole lines
    bool is_demand_met = true;       // false: exit 1, and the last note says why
    std::optional<Proposal> proposal;
    std::optional<Preview> preview;
    std::optional<std::filesystem::path> plan;  // that was written
    bool pieces_written = false;
};

// What was discarded, in the same words and keys in every report:
// "discarded after cut 2: piece C, 1,234 faces, 12.345 ml (3.21 % of the scan)", none if nothing is discarded;
// [ { name, after, cut, faces, volume_mm3 } ... ], after so many cuts, made by cut, 0 for the scan.
std::vector<std::string> discarded_lines(const Project& project);
nlohmann::ordered_json discarded_json(const Project& project);

std::vector<std::string> lines(const SegmentAnswer& answer, const std::filesystem::path& folder,
                               const Project& project);
std::string document(const SegmentAnswer& answer, const std::filesystem::path& folder, const Project& project);

}  // namespace qchopper
