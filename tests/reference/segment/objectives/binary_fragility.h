// Binary fragility of one plane (segment/objectives/sweep/binary_fragility.h), vertex by vertex.
//
// mm.

#pragma once

#include "segment/cut/piece.h"
#include "segment/mesh/plane.h"

namespace qchopper {

// 1 if a vertex is left that stands over material which the cut would leave thin, else 0. Preconditions: a closed mesh,
// the normal canonical (plane.h), distance >= 0. O(triangles), and a ray per vertex that counts.
double binary_fragility(const Piece& piece, const Plane& plane, double distance);

}  // namespace qchopper
