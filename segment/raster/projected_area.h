// Measures the area of a mesh's projection.

#pragma once

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Area of the projection along the unit vector `up`, holes left out, measured on a grid: the error is about a hundredth
// of the box around the projection (tests/segment/raster/projected_area_test.cpp). 0 if that box has no area. O(points
// + triangles).
double projected_area_mm2(const TriangleMesh& mesh, Vec3 up);

}  // namespace qchopper
