// Measures by samples how far the faces of one mesh are from the surface of another, caps left out.
//
// Lengths are mm. Simplification keeps caps as they are (simplify.h), so they deviate by nothing. The result does not
// depend on the number of threads (tests/segment/simplify/simplify_test.cpp).

#pragma once

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The largest distance of samples of the faces of `from` to the surface of `to`; 0 if `from` has no face but caps. The
// samples of a face are its corners and its middle; the points that divide each side in equal steps; and, if the grid
// below has more than one step, the inner points of that grid and the middles of those of its cells that are turned as
// the face is. A side has as many steps as the mean longest side of the faces of `to` fits in it, rounded up, at most
// 200; the grid has as many along each side as the longest side of the face has. Preconditions: `to` has a face besides
// caps; the two faces at an edge run along it in opposite directions (edges.h). Throws Cancelled.
double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context = {});

}  // namespace qchopper
