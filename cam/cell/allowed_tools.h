// A cell of which only some tools may be used.
//
// Everything that plans with the tools of a cell then knows no others (tests/cam/cell/allowed_tools_test.cpp).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// The cell without its other tools; `numbers` empty: as it is. Throws InputError (use) if the cell has no machine, has
// no tool of a number, or if none of the tools is ball-ended, because others do not finish. O(tools).
Cell with_tools(const Cell& cell, const std::vector<std::uint16_t>& numbers);

// "tool 3", "tools 1, 2 and 4". Precondition: there is one.
std::string describe_tools(const std::vector<std::uint16_t>& numbers);

}  // namespace qchopper
