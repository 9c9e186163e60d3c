// The outline that a plane would cut out of a piece, without cutting it.
//
// Closed polylines in mm, counter-clockwise around material seen against the normal; their points are those that the
// caps of the cut get, to the last bit (tests/app/project/outline_test.cpp).

#pragma once

#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/plane.h"

namespace qchopper {

struct Outline {
    std::vector<std::vector<Vec3>> loops;  // the first point is not repeated at the end
    double length_mm = 0;                  // of all loops
    Box box;
};

// No loops: the plane misses. The mesh must be closed where the plane passes.
Outline outline(const TriangleMesh& mesh, const Plane& plane);

}  // namespace qchopper
