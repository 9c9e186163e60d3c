// The work envelope of a piece in the reports of several commands: a word, lines and JSON.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cam/setup/placement/machine_reachability.h"

namespace qchopper {

// "axis 5 and its upper limit 4.2 deg", the tightest margin; "-" where the arm was not checked.
std::string margin_word(const MachineReachability& reachability);
// "x 150, y -20 mm, turned 30 degrees", from the middle of the table.
std::string place_word(const BlockPlacement& placement);
// The sentence on the piece, then a table of the checks. None where the arm was not checked.
std::vector<std::string> lines(const std::string& piece, const MachineReachability& reachability);
// Angles in degrees, lengths in mm (docs/user/envelope.md).
nlohmann::ordered_json json_of(const MachineReachability& reachability);

}  // namespace qchopper
