// All turns of joints within their ranges: what inverse_within() (cam/cell/arm.h) chooses from.
//
// Radians.

#pragma once

#include <vector>

#include "cam/cell/arm.h"

namespace qchopper {

// All joints that differ from the given ones by whole turns of axes and lie in the ranges less `margin` (radians), in
// ascending order of joint 1, then of joint 2 and so on. None if a joint or a range is not finite. Their number is the
// product of the numbers of turns of the six axes.
std::vector<Joints> turns_within(const JointRanges& ranges, double margin, const Joints& joints);

}  // namespace qchopper
