// The convex hull of points, as the planes of its sides.
//
// mm. Tests: tests/segment/regions/convex_hull_test.cpp.

#pragma once

#include <vector>

#include "segment/mesh/plane.h"

namespace qchopper {

struct ConvexHull {
    std::vector<Vec3> points;  // its corners
    std::vector<Plane> sides;  // of its triangles, normals outwards; none if all points lie in a plane
    double area = 0;           // mm2; 0 without sides
    double volume = 0;         // mm3
};

// Points may be equal. O(n log n) on average.
ConvexHull convex_hull_of(const std::vector<Vec3>& points);

}  // namespace qchopper
