// Triangulates a region by ear clipping, for caps that have no Delaunay triangulation (cap.h).
//
// Plane coordinates, mm. Always N + 2L - 4 triangles for N points and L loops, each loop edge in exactly one of them,
// whatever the geometry. Triangles do not overlap if the loops do not cross (tests/segment/cut/cap_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

// `outer` is counter-clockwise and the holes are clockwise; otherwise triangles overlap. Precondition: each loop has
// three points or more. O(N^2) as a rule.
std::vector<std::array<std::uint32_t, 3>> clip_ears(std::span<const Point2> points, const Loop& outer,
                                                    std::span<const Loop> holes);

}  // namespace qchopper
