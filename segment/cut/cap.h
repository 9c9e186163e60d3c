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

namespace qchopper {

struct Point2 {
    double x = 0;
    double y = 0;
    bool operator==(const Point2&) const = default;
};

// Point numbers in order, counter-clockwise around material and clockwise around holes.
using Loop = std::vector<std::uint32_t>;

// Signed area by the shoelace formula: positive counter-clockwise.
double signed_area(std::span<const Point2> points, const Loop& loop);

// One outer loop and the holes in it, as indices of loops.
struct CapRegion {
    std::size_t outer = 0;
    std::vector<std::size_t> holes;
    bool is_simple = true;  // false: a loop runs the wrong way round for its nesting depth
};

// Even-odd nesting: a loop inside an odd number of others is a hole of the smallest one around it.
std::vector<CapRegion> nest(std::span<const Point2> points, std::span<const Loop> loops);

struct CapTriangles {
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
    std::size_t regions = 0;
    std::size_t forced_regions = 0;  // loops that cross or touch themselves: closed all the same, but not flat-covered
};
CapTriangles triangulate_caps(std::span<const Point2> points, std::span<const Loop> loops);

}  // namespace qchopper
