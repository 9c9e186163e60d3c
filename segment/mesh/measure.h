// Measures a mesh: box, volume, area.
//
// mm, mm2, mm3. Each in one pass over the points or triangles (tests/segment/mesh/measure_test.cpp).

#pragma once

#include "base/box.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Axis-parallel box of all points, also of those without a triangle; both corners at the origin if there is no point.
Box bounds(const TriangleMesh& mesh);

// Signed volume in mm3 of a closed mesh (divergence theorem): positive when the triangles face outwards.
double volume_mm3(const TriangleMesh& mesh);

// Sum of the areas of all triangles, caps included.
double area_mm2(const TriangleMesh& mesh);

}  // namespace qchopper
