// Where a straight line crosses a triangle: the predicate of containment.h and solids.h.
//
// mm. Both triangles at an edge get the same point of it to the last bit, and a corner at the height or side of the
// line counts as above it; so a line crosses every closed surface an even number of times, also through vertices and
// along edges (tests/segment/mesh/connectivity/containment_test.cpp). O(1). This is the half-open rule of the crossing
// number (M. Shimrat, "Algorithm 112: position of point relative to polygon", 1962), applied twice.

#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace qchopper {

// A point in the coordinates of a line: two across it, height and side, and its position along it.
struct LineCoordinates {
    double height = 0;
    double side = 0;
    double along = 0;
};

// The point of an edge at a height, computed from its upper end whichever end is given first. Precondition: exactly one
// end is at or above the height.
inline LineCoordinates edge_at_height(const LineCoordinates& a, const LineCoordinates& b, double height) {
    const LineCoordinates& upper = a.height >= height ? a : b;
    const LineCoordinates& lower = a.height >= height ? b : a;
    const double f = (upper.height - height) / (upper.height - lower.height);
    return {height, upper.side + f * (lower.side - upper.side), upper.along + f * (lower.along - upper.along)};
}

// The position along the line at this height and side where it crosses the triangle; nothing if it does not.
inline std::optional<double> line_crossing(const std::array<LineCoordinates, 3>& corner, double height, double side) {
    std::array<LineCoordinates, 2> end;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const LineCoordinates& a = corner[k];
        const LineCoordinates& b = corner[(k + 1) % 3];
        if ((a.height >= height) != (b.height >= height)) end[count++] = edge_at_height(a, b, height);
    }
    if (count != 2 || (end[0].side >= side) == (end[1].side >= side)) return std::nullopt;
    const LineCoordinates& right = end[0].side >= side ? end[0] : end[1];
    const LineCoordinates& left = end[0].side >= side ? end[1] : end[0];
    return right.along + (right.side - side) / (right.side - left.side) * (left.along - right.along);
}

}  // namespace qchopper
