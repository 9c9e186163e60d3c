// How long a tool path takes, line by line, with acceleration, the cycle of interpolation and tool changes.
//
// Seconds and mm. A line goes at its feed, with ramps of its acceleration, and takes at least one cycle. It begins and
// ends with the largest speed that both neighbours, the corner and the acceleration allow: one pass forwards, one
// backwards. At a corner that is not rounded the tip stands. At a rounded one the tip passes two sides of length a
// (rounded_corner.h), and its speed v is at most
// - the feeds of both lines;
// - sqrt(acceleration * radius of the parabola in its middle);
// - what the axes allow: the rate dq/ds of an axis (JointRates) changes by d in the corner, its speed by d v in a time
//   of 2 a / v, so that d v^2 / (2 a) <= A, its largest acceleration: v <= sqrt(2 a A / d).
// Along a line the axis speeds up by dq/ds times the acceleration of the tip, which is at most A / (dq/ds) therefore.
// That dq/ds changes along a line is left out. Waiting for the spindle, turns of the table and questions that are no
// tool change are not counted. tests/sim/replay/time_account_test.cpp, ball_test.cpp.

#pragma once

#include <array>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// What the cell allows. The defaults bound nothing and take no time.
struct MotionLimits {
    double cycle_s = 0;                                      // of interpolation
    std::array<double, axes_of_arm> axis_acceleration = {};  // largest, radians/s2; 0: any
    double tool_change_s = 0;
};

// Of a cell with a robot.
MotionLimits motion_limits(const CellMachine& machine);

// The acceleration of the tip at which no axis exceeds its own.
double tip_acceleration(const JointRates& rates, const MotionLimits& limits);

struct LineTime {
    double seconds = 0;
    double end_speed = 0;  // mm/s; 0: the tip stands
};

struct PathTime {
    double seconds = 0;  // lines, joint moves and tool changes
    double line_mm = 0;
    std::vector<LineTime> lines;  // of each line of the path
};

PathTime time_of(const ToolPath& path, const MotionLimits& limits = {});

}  // namespace qchopper
