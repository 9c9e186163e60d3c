// Into how many boxes of a size a larger box is divided.
//
// mm. Tests: tests/segment/mesh/boxes_needed_test.cpp.

#pragma once

#include "base/vec3.h"

namespace qchopper {

// The least number of boxes that each fit in `limit`, all in the same order of their axes, into which planes along its
// axes divide a box: 1 if it fits. Infinite where a limit is not positive. Lengths that differ by less than 1e-6 are
// equal, and a length may exceed a number of boxes by the share `tolerated` of one. O(1).
double boxes_needed(Vec3 size, Vec3 limit, double tolerated = 0);

}  // namespace qchopper
