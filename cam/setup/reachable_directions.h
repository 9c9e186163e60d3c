// Which directions the arm can hold over a block in the middle of the table: a first check, before any toolpath.
//
// The tool tip is asked for at the middle of the piece's box and at those corners of it that belong to a side which
// faces the direction; any redundancy angle will do. The tool is the one with the largest stick-out, the first
// of equal ones. A rotary table is turned as the direction needs: one angle for all points. No collision and no way
// between poses is checked here.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "cam/cell/cell.h"

namespace qchopper {

// The setup frame stands over the middle of the table, its z = 0 at the table's top plus `spoil` (mm); its axes are
// those of the cell, or of the rotary table at angle 0.
Pose setup_in_cell(const Cell& cell, double spoil);

// Per direction (unit, in setup coordinates, the tool axis): 1 if it can be held, else 0. `box` is the
// piece's, in setup coordinates. A rotary table is tried every 15 degrees and with the tool leaning straight away from
// the robot's base and straight towards it. A gantry holds straight up alone, wherever its reach box lies; a cell
// without a machine holds all, because nothing is known of its arm. O(directions x angles x points) answers
// of the inverse kinematics at most.
std::vector<std::uint8_t> reachable_directions(const Cell& cell, const Box& box, double spoil,
                                               std::span<const Vec3> directions);

}  // namespace qchopper
