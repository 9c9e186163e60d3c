// Finds a small box of any orientation around points.
//
// mm. The axes are the result of a seeded search, a heuristic: the box need not be the smallest one. It contains every
// point, because its extents are computed from all of them (tests/segment/mesh/oriented_box_test.cpp). Same points,
// same box.

#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace qchopper {

struct OrientedBox {
    std::array<Vec3, 3> axis;  // right-handed, unit, longest extent first; each with its first non-zero component
                               // positive except the third, which keeps the frame right-handed
    Vec3 min;                  // least coordinate of the points along each axis
    Vec3 max;                  // largest
    Vec3 size() const { return max - min; }
};

// The axes are those of the world if all points lie in a plane. Precondition: there is a point. O(points) for each of
// 256 directions at worst.
OrientedBox oriented_box(std::span<const Vec3> points);

}  // namespace qchopper
