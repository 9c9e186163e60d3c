// Measures the footprint of a piece, its vertical projection on the table: smallest rectangle.
//
// Plane coordinates in mm. No direction gives a smaller rectangle (tests/segment/mesh/footprint_test.cpp).

#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

// The corners counter-clockwise, the lowest of the leftmost first, no three in line. Fewer than three where all points
// coincide or lie in a line.
std::vector<Point2> convex_hull(std::vector<Point2> points);

struct Rectangle {
    Point2 along{1, 0};  // unit vector of the long side
    double length = 0;
    double width = 0;  // never more than the length
    double area() const { return length * width; }
};
// The rectangle of least area around the points; its sizes are 0 for no points or a single one.
Rectangle smallest_rectangle(std::vector<Point2> points);

// Two unit vectors that, with the unit vector `up` as the third, make a right-handed frame.
std::array<Vec3, 2> frame_under(Vec3 up);

}  // namespace qchopper
