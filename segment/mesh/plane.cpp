// Scales by 1 / length, and by -1 where the first non-zero component is negative. O(1).

#include "segment/mesh/plane.h"

#include <cmath>

namespace qchopper {

Plane canonical(const Plane& plane) {
    const double length = norm(plane.normal);
    const Vec3 n = plane.normal;
    const bool flip = n.x < 0 || (n.x == 0 && (n.y < 0 || (n.y == 0 && n.z < 0)));
    double scale = flip ? -1 : 1;
    if (std::abs(length - 1) > 1e-14) scale /= length;  // an already unit normal keeps its bits
    // 0.0 + x turns -0.0 into 0.0, so that equal planes have equal bits.
    return {{0.0 + scale * n.x, 0.0 + scale * n.y, 0.0 + scale * n.z}, 0.0 + scale * plane.offset};
}

}  // namespace qchopper
