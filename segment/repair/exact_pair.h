// Exact answers about one or two triangles in space, whatever the rounding.
//
// What "meet" means stands in self_intersections.h.

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

using Corners = std::array<Vec3, 3>;

// Whether the corners do not lie on one line.
bool has_area(const Corners& triangle);

// Whether two triangles meet elsewhere than in corners at the same place and the edges between those. Both must have an
// area.
bool do_meet(const Corners& a, const Corners& b);

}  // namespace qchopper
