// Triangulates the flat regions that a plane cuts out of a solid.
//
// Works in plane coordinates (mm). No point is added or merged: a region of L loops with N points in all gets exactly
// N + 2L - 4 triangles, and every loop edge is an edge of exactly one of them, whatever the loops look like - so the
// halves close again also where the input intersects itself (tests/segment/cut/cap_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/polygon_nesting.h"

namespace qchopper {

struct CapTriangles {
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
    std::size_t regions = 0;
    std::size_t forced_regions =
        0;  // loops that cross, or run the wrong way round: closed all the same, but the cap folds
};
CapTriangles triangulate_caps(std::span<const Point2> points, std::span<const Loop> loops);

// The loops that take a cap. Two triangles that meet along two edges leave a loop of two points: it closes by itself.
std::vector<Loop> capped(std::vector<Loop> loops);

// The same with the regions given, as nest() makes them of capped loops.
CapTriangles triangulate_regions(std::span<const Point2> points, std::span<const Loop> loops,
                                 std::span<const CapRegion> regions);

}  // namespace qchopper
