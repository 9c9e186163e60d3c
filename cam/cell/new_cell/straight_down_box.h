// Where the table of a new cell can stand: a box in which an arm holds the tool straight down.
//
// mm. Used for files that are to be edited (cam/cell/new_cell/new_cell.h); the work envelope is checked elsewhere, with
// the bodies of the machine (cam/setup/placement). Pure. O(candidates * points of a grid).

#pragma once

#include <optional>

#include "base/box.h"
#include "cam/cell/arm.h"

namespace qchopper {

struct StraightDownQuestion {
    ArmGeometry arm;
    JointRanges ranges;
    Pose base_in_cell;
    double tool_length = 0;   // from the flange to the tip, along the flange's z
    double least_height = 0;  // of the box's underside in the cell
};

// A box in front of the arm, in the cell, at most 1,200 x 1,200 x 800 and of these proportions: the arm holds the tip
// at each point of a grid of 5 x 5 x 5 in it, pointing down, with 3 degrees to spare at every joint limit. It is
// smaller than the largest such box by a fifth and stands in the middle of the places where it could, so that the arm
// can tilt the tool there. Nothing where not even a box 200 wide is held.
std::optional<Box> straight_down_box(const StraightDownQuestion& question);

}  // namespace qchopper
