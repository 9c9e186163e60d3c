// How far samples of one surface are from another: corners, middles of edges and insides of faces.
//
// Lengths are mm. A face is divided until its samples lie as dense as the corners of the other mesh do on the average,
// so that a large face over many small ones is looked at everywhere (tests/segment/simplify/simplify_test.cpp).

#pragma once

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The largest distance of all samples of `from` to the surface `to`; both have triangles.
double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context = {});

}  // namespace qchopper
