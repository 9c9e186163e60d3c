// Exact predicates for one or two triangles in space, free of rounding errors.
//
// self_intersections.h defines "meet" (tests/segment/repair/intersections/self_intersections_test.cpp).

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

using Corners = std::array<Vec3, 3>;

// Whether the corners do not lie on one line.
bool has_area(const Corners& triangle);

// Whether two triangles meet elsewhere than in corners with equal coordinates and the edges between those.
// Precondition: both have an area.
bool do_meet(const Corners& a, const Corners& b);

}  // namespace qchopper
