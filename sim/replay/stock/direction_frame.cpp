// Two cross products with the axis that is least along the direction.

#include "sim/replay/stock/direction_frame.h"

#include <cmath>

namespace qchopper {

Pose direction_frame(Vec3 out) {
    if (std::hypot(out.x, out.y) < 1e-9 && out.z > 0) return {};
    const Vec3 beside = std::abs(out.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 y = normalized(cross(out, beside));
    const Vec3 x = cross(y, out);
    return {{Vec3{x.x, y.x, out.x}, Vec3{x.y, y.y, out.y}, Vec3{x.z, y.z, out.z}}, {}};
}

}  // namespace qchopper
