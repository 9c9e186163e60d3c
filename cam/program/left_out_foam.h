// Foam that stays where cuts of a toolpath are left out, and the moves that may meet it.
//
// mm, in setup coordinates. A toolpath counts on every cut: a link over foam that a cut was to remove would go at full
// speed through what stays, and a later cut would remove it at the feed for the little that the toolpath knows there
// (tests/cam/program/left_out_foam_test.cpp).

#pragma once

#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/cell/shape_distance.h"
#include "cam/program/program.h"

namespace qchopper {

// Bodies that hold all foam that a straight cut would have removed up to the retract plane, whose height along the tool
// axis is `retract`. O(length / radius).
std::vector<Capsule> bodies_of_cut(Vec3 from, Vec3 to, Vec3 tool_axis, double radius, double retract);

// Gives moves that come within 5 mm of one of the bodies the least feed of the tool, if they are faster and do not go
// straight up along it. How many.
// O(moves * (1 + length / radius) * bodies).
std::size_t slow_moves_near(const std::vector<Capsule>& bodies, const CuttingTool& tool, double retract,
                            ProgramOperation& operation);

}  // namespace qchopper
