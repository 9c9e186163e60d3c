// Two cross products with the axis that is least along the direction.

#include "sim/replay/stock/tool_axis_frame.h"

#include <cmath>

namespace qchopper {

Pose tool_axis_frame(Vec3 tool_axis) {
    if (std::hypot(tool_axis.x, tool_axis.y) < 1e-9 && tool_axis.z > 0) return {};
    const Vec3 beside = std::abs(tool_axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 y = normalized(cross(tool_axis, beside));
    const Vec3 x = cross(y, tool_axis);
    return {{Vec3{x.x, y.x, tool_axis.x}, Vec3{x.y, y.y, tool_axis.y}, Vec3{x.z, y.z, tool_axis.z}}, {}};
}

}  // namespace qchopper
