// Takes small round patches of triangles out of a closed mesh, so that it has holes like a real scan.
//
// Each patch is a disc: it leaves one border loop that touches neither itself nor another one
// (tests/segment/sample/punch_test.cpp).

#pragma once

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The patches lie far apart and differ in size. Returns how many were taken out: fewer than `holes` only when there is
// no room for more.
int punch_holes(TriangleMesh& mesh, int holes);

}  // namespace qchopper
