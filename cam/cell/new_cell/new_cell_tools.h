// Tools and blocks of a new cell file (new_cell.h): those of the ready cells, marked as assumed.

#pragma once

#include <string>

#include "base/vec3.h"

namespace qchopper {

// From the spindle nose to the tip of every tool but the long ones, mm.
constexpr double new_tool_length = 200;

// The tables [[tool]]. A light arm has no wide and no long ones.
std::string new_tools_text(bool is_light);

// The tables [[stock]]: of the blocks of ready cells those that a box of that size (mm) holds with a tool around them,
// else one that it does hold.
std::string new_stock_text(Vec3 box);

}  // namespace qchopper
