// What a piece covers on the table, seen along one direction: its rectangle and its projected area.
//
// Millimetres. No turn of a footprint has a smaller rectangle (tests/cam/setup/footprint_test.cpp).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

using FootPoint = std::array<double, 2>;

// Counter-clockwise corners, the lowest of the leftmost first, no three in line. Fewer than three where all points
// are one or lie in a line.
std::vector<FootPoint> convex_hull(std::vector<FootPoint> points);

// The rectangle of least area around the points.
struct Rectangle {
    FootPoint along{1, 0};  // unit vector of the long side
    double length = 0;
    double width = 0;  // never more than the length
    double area() const { return length * width; }
};
Rectangle smallest_rectangle(std::vector<FootPoint> points);

// Two unit vectors that make a right-handed frame with the unit vector `up`.
std::array<Vec3, 2> frame_under(Vec3 up);

// Area of the projection along `up`, on a grid: good to about a hundredth of its box.
double projected_area_mm2(const TriangleMesh& mesh, Vec3 up);

}  // namespace qchopper
