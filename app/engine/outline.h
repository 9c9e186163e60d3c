// The outline of the section of a piece by a plane, without cutting it.
//
// Closed polylines in mm, counter-clockwise around material seen against the normal. Their points are those of the caps
// that a cut would make, to the last bit (tests/app/engine/outline_test.cpp).

#pragma once

#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/plane.h"

namespace qchopper {

struct Outline {
    std::vector<std::vector<Vec3>> loops;  // the first point is not repeated at the end
    double length_mm = 0;                  // of all loops
    Box box;                               // of all points; default without loops
};

// No loops if the plane misses. Precondition: the mesh is closed where the plane passes. O(triangles).
Outline outline(const TriangleMesh& mesh, const Plane& plane);

}  // namespace qchopper
