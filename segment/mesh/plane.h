// A plane n.p = offset; n is a unit vector, the offset a signed distance from the origin in mm.

#pragma once

#include "base/vec3.h"

namespace qchopper {

struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
    bool operator==(const Plane&) const = default;
};

// Height of a point along a normal. Which side of a cut a point lies on is decided by this one function alone, so
// that every place that asks gets the same bits.
inline double height(Vec3 normal, Vec3 point) {
    return dot(normal, point);
}

// The same plane with its first non-zero normal component positive and the normal of length 1.
Plane canonical(const Plane& plane);

}  // namespace qchopper
