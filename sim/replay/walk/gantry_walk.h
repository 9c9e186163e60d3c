// Executes a parsed program on a gantry of three axes: tools, their lengths, travel, what stands in its way.
//
// The tip is where the program says, in the frame of the work offset, which is the setup's. A rapid is looked at
// straight and as a way on which both axes go equally fast until one is there. A corner that is rounded by a deviation
// P is left a = min(2 P / cos(b / 2), L / 2) before it, b the angle between the moves. O(moves)
// (tests/sim/replay/walk/gantry_walk_test.cpp).

#pragma once

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// Preconditions: as walk_machine(), and the cell's machine has no robot. Throws Cancelled.
ToolPath walk_gantry(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log, const Context& context);

}  // namespace qchopper
