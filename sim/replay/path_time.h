// How long a tool path takes, with acceleration.
//
// Seconds and mm. Every line begins and ends with the largest speed that both neighbours, the rounding of the corner
// and the acceleration allow: 0 where the corner is exact, else at most sqrt(acceleration * radius of the parabola in
// its middle). One pass forwards, one backwards. Waiting for the spindle and for people is not counted.
// tests/sim/replay/path_time_test.cpp.

#pragma once

#include "sim/replay/tool_path.h"

namespace qchopper {

struct PathTime {
    double seconds = 0;
    double line_mm = 0;
};

PathTime time_of(const ToolPath& path);

}  // namespace qchopper
