// Removes small round discs of triangles from a closed mesh, so that it has holes like a real scan.
//
// Each disc leaves one border loop that touches neither itself nor another one (tests/segment/sample/punch_test.cpp).
// Same mesh, same holes. Precondition: the mesh is closed (edges.h) and every point has a triangle.

#pragma once

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The discs lie far apart and differ in size. Returns their number: fewer than `holes` only if there is no room for
// more. Points without a triangle are removed; the others, and the triangles, keep their order.
int punch_holes(TriangleMesh& mesh, int holes);

}  // namespace qchopper
