// A drawing of an arm's lengths a1 to c4, to compare with the data sheet.

#pragma once

#include <string>

#include "cam/cell/robot.h"

namespace qchopper {

// An SVG file, 1,000 x 1,120 units: the arm from the side as the lengths are defined, straight up with all angles at
// zero; a dimension line with the number (mm) for each length; a table of zero positions, signs, ranges and speeds.
std::string draw_arm(const Robot& robot);

}  // namespace qchopper
