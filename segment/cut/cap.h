// Triangulates the flat regions that a plane cuts out of a solid.
//
// Plane coordinates, mm. No point is added or merged: a region of L loops with N points in all gets exactly N + 2L - 4
// triangles, and every loop edge is an edge of exactly one of them, whatever the geometry of the loops. So the halves
// of a cut are closed also where the input intersects itself (tests/segment/cut/cap_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/polygon_nesting.h"

namespace qchopper {

struct CapTriangles {
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise; corners are indices of the points
    std::size_t forced_regions = 0;  // with loops that cross or have the wrong orientation: their triangles overlap
};

// The loops that get a cap: those of three points or more. Two triangles that meet along two edges leave a loop of two
// points, which needs none.
std::vector<Loop> capped(std::vector<Loop> loops);

// `loops` are capped ones, and `regions` are those of nest_polygons().
CapTriangles triangulate_regions(std::span<const Point2> points, std::span<const Loop> loops,
                                 std::span<const CapRegion> regions);

}  // namespace qchopper
