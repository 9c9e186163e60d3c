// Executes a parsed program on the arm of a cell: joints, limits, frames, spindle, collisions with what stands still.
//
// Every line and the poses between, at most 5 mm or 2 degrees apart. A PTP is linear in the joints, all axes
// synchronous; a LIN is followed by inverse kinematics on the branch that the PTP before it reached. The tip is that of
// the tool that the job names, wherever $TOOL says it is: where the program is wrong, the tip goes wrong.
// O(poses) (tests/sim/replay/replay_test.cpp).

#pragma once

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// Preconditions: the cell has a machine with a robot, every tool that a chunk names is one of it, every direction is an
// index. Throws Cancelled.
ToolPath walk_machine(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log, const Context& context);

}  // namespace qchopper
