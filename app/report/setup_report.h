// The answer of setup: tables for people, one JSON document for programs. Lengths in mm, shares of a piece's area
// without its base.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/engine/setup_project.h"
#include "app/report/document.h"

namespace qchopper {

// "cut 2", or "side 3" of a piece that has no cap that can carry it.
std::string base_word(const Setup& setup);
// "3.14 %"
std::string share_word(double share);

// "piece A: 30.11 % of its surface is out of reach, more than 2.00 %"
std::string out_of_reach_sentence(const std::string& piece, double share, double limit);

// One for each piece that is shown of which the setup in force leaves more out of reach than may be.
std::vector<std::string> warnings(const SetupAnswer& answer);
// Said of a cell that describes no arm; empty for any other.
std::string arm_note(const Cell& cell);

// What setup and prepare say of a setup, with the keys of the manifest; the tool axes in piece coordinates.
void add_setup(nlohmann::ordered_json& json, const Setup& setup, const Cell& cell);

// The key margins_mm: how much room is left for each condition of the block in the cell, by its name; negative: so much
// is missing.
void add_margins(nlohmann::ordered_json& json, const StockFit& fit);

std::vector<std::string> lines(const SetupAnswer& answer);
// The document qchopper-setup-2 (tests/app/cli/setup_test.cpp).
Document document(const SetupAnswer& answer);

// Of the pieces that a plane would make: as for those of a project, and what becomes of their surface.
std::vector<std::string> lines(const PlaneSetups& plane);
nlohmann::ordered_json plane_setups_json(const PlaneSetups& plane);

}  // namespace qchopper
