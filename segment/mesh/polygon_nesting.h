// Polygon nesting: the flat regions that a plane cuts out of a solid, each an outer loop with its holes.
//
// Plane coordinates, mm. The cut and the sweep call this one function with the same points to the last bit, so their
// regions are the same, also where loops touch or cross (tests/segment/objectives/sweep/touching_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

// One outer loop and the holes in it, as indices of loops.
struct CapRegion {
    std::size_t outer = 0;
    std::vector<std::size_t> holes;
    bool is_simple = true;  // false: a loop is oriented against its nesting depth, or a hole has no outer loop
};

// By the even-odd rule: a loop inside an odd number of others is a hole of the smallest outer loop around it. Every
// loop is in exactly one region. Loops may touch. Precondition: every loop has three points or more. O(L^2 + L N) for L
// loops of N points in all while few edges lie in one row.
std::vector<CapRegion> nest_polygons(std::span<const Point2> points, std::span<const Loop> loops);

}  // namespace qchopper
