// What robot programs in every language need of the signals of a cell file, and what the person at the controller is
// asked.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// Throws InputError (config) if the cell file names no signal for spindle.on or spindle.at_speed, or none that switches
// the spindle off.
void check_signals(const CellMachine& machine);

// "tool 1 (ball nose 20 mm) is in the spindle, 200.00 mm from the nose to the tip: check its length"
std::string tool_question(const CuttingTool& tool);

// "tool 1, ball nose 20 mm: 200.00 mm from the nose to the tip, stick-out 110.00 mm"
std::string tool_words(const CuttingTool& tool);

// The same in sentences of at most 80 characters, for dialogs; of a longer name the first 45 characters:
// "Put tool 1 (ball nose 20 mm) into the spindle.", "Measure tool 1: 200.00 mm from nose to tip, stick-out 110.00
// mm."
std::vector<std::string> krl_tool_questions(const CuttingTool& tool);

// "part 1 has ended, and this is the same block, not moved": before the part behind it, counted from 0.
std::string part_question(std::size_t part);

// "the chunks before qc_7_005 have ended, and this is the same block, not moved": before a program that begins with a
// chunk but the first.
std::string restart_question(const std::string& chunk);

}  // namespace qchopper
