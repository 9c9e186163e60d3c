// The plane normal.p = offset: the normal is a unit vector, the offset the signed distance from the origin in mm.

#pragma once

#include "base/vec3.h"

namespace qchopper {

struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
    bool operator==(const Plane&) const = default;
};

// Height of a point along a normal, in mm. This function alone decides on which side of a cut a point lies, so that
// every caller gets the same bits.
inline double height(Vec3 normal, Vec3 point) {
    return dot(normal, point);
}

// The same plane with a normal of length 1 whose first non-zero component is positive. A plane that is so already keeps
// its bits. Precondition: the normal is not zero.
Plane canonical(const Plane& plane);

}  // namespace qchopper
