// The three points of a block from which the operator touches off the base frame of the program.
//
// mm, setup coordinates. Glue faces decide where the skin of two pieces meets, so the frame is taken from them where
// the block has some at its sides (tests/cam/job/sheet/touch_points_test.cpp).

#pragma once

#include <array>
#include <string>

#include "cam/setup/setup.h"

namespace qchopper {

// How exactly a block with glue faces at its sides must lie against the frame. Skin is milled in the frame of the
// program and the joint is sawn: a block that is off by e along a joint makes a step of up to 2 e in the skin. Assumed,
// about what touching off with a tool tip gives.
constexpr double touch_off_mm = 0.2;
constexpr double touch_off_deg = 0.02;

struct TouchPoint {
    std::string name;
    std::string where;
    Vec3 at;
};

// With glue faces at the sides: the first two near the ends of the largest one, the third in the middle of the one to
// touch at right angles to it, or else at a corner of the block's top on that largest one. Without: three corners of
// the block's top, the first two along x, the third gives the side of y.
std::array<TouchPoint, 3> touch_points(const Setup& setup);

}  // namespace qchopper
