// Plain measurements of a mesh: box, volume, area.

#pragma once

#include "base/box.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Axis-parallel box of all points; {0,0} for none.
Box bounds(const TriangleMesh& mesh);

// Signed volume in mm3 of a closed mesh (divergence theorem): positive when the triangles face outwards.
double volume_mm3(const TriangleMesh& mesh);

double area_mm2(const TriangleMesh& mesh);

}  // namespace qchopper
