// Two directions perpendicular to a normal and to each other: coordinates in a plane.
//
// The same normal always gives the same frame. O(1).

#pragma once

#include <cassert>
#include <cmath>

#include "base/vec3.h"

namespace qchopper {

// u, v and the normal are right-handed. u is a unit vector, v is as long as the normal.
struct PlaneFrame {
    Vec3 u;
    Vec3 v;
};

// Starts from the world axis whose direction differs most from the normal's. Precondition: the normal is not zero.
inline PlaneFrame frame_across(Vec3 normal) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    const Vec3 u = normalized(cross(axis, normal));
    assert(std::abs(dot(u, normal)) <= 1e-9 * norm(normal));
    return {u, cross(normal, u)};
}

}  // namespace qchopper
