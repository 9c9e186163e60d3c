// The smallest box in any orientation, as near as a seeded search finds it.
//
// Heuristic: never test for an exact minimum. The box contains every point, because its extents are taken on all of
// them once the axes are found (tests/segment/mesh/oriented_box_test.cpp).

#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace qchopper {

struct OrientedBox {
    std::array<Vec3, 3> axis;  // right-handed, unit, longest extent first; each with its first non-zero component
                               // positive except the third, which keeps the frame right-handed
    Vec3 min;                  // least and largest coordinate along each axis
    Vec3 max;
    Vec3 size() const { return max - min; }
};

OrientedBox oriented_box(std::span<const Vec3> points);

}  // namespace qchopper
