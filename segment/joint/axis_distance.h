// Distances from a straight axis of finite length, for holes that keep clear of a surface and of each other.
//
// mm. Exact but for rounding; O(1) each (tests/segment/joint/axis_distance_test.cpp). Segments: C. Ericson, "Real-Time
// Collision Detection" (2005), section 5.1.9.

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

struct Axis {
    Vec3 begin;
    Vec3 end;
};

// Between the nearest points of two segments; a segment may be a point.
double distance_between(const Axis& a, const Axis& b);

// From a segment to the nearest point of a triangle, its interior included; 0 where they cross.
double distance_between(const Axis& axis, const std::array<Vec3, 3>& triangle);

}  // namespace qchopper
