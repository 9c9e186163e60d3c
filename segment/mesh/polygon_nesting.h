// Which loops of a section are holes of which: the flat regions that a plane cuts out of a solid.
//
// Plane coordinates, mm. The cutter and the sweep ask this one function with the same points to the last bit, so they
// agree, also where loops touch or cross (tests/segment/score/touching_test.cpp).

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
    bool is_simple = true;  // false: a loop runs the wrong way round for its nesting depth
};

// Even-odd nesting: a loop inside an odd number of others is a hole of the smallest one around it. Loops may touch: a
// point tells where its loop lies only if it is not on the other loop.
std::vector<CapRegion> nest(std::span<const Point2> points, std::span<const Loop> loops);

}  // namespace qchopper
