// The frame in which a direction of a setup is looked at: z along the direction, mm.

#pragma once

#include "base/pose.h"

namespace qchopper {

// The same for the same unit vector; of (0, 0, 1) the identity. Its origin is that of the setup.
Pose tool_axis_frame(Vec3 tool_axis);

}  // namespace qchopper
