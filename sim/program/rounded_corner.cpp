// Half angles by half sums and half differences of unit vectors.

#include "sim/program/rounded_corner.h"

#include <algorithm>
#include <limits>

namespace qchopper {

RoundedCorner round_corner(Vec3 from, Vec3 corner, Vec3 to, double distance) {
    RoundedCorner rounded{corner, corner, corner, 0, 0, std::numeric_limits<double>::infinity()};
    const double l1 = norm(corner - from);
    const double l2 = norm(to - corner);
    const double a = std::min({distance, 0.5 * l1, 0.5 * l2});
    if (!(a > 0)) return rounded;
    const Vec3 d1 = (1 / l1) * (corner - from);
    const Vec3 d2 = (1 / l2) * (to - corner);
    rounded.before = corner - a * d1;
    rounded.after = corner + a * d2;
    rounded.a = a;
    // b is the angle between -d1 and d2.
    const double cos_half = 0.5 * norm(d2 - d1);
    const double sin_half = 0.5 * norm(d1 + d2);
    rounded.deviation = 0.5 * a * cos_half;
    if (cos_half > 0) rounded.radius = a * sin_half * sin_half / cos_half;
    return rounded;
}

}  // namespace qchopper
