// Adds triangles to a closed mesh without changing its shape.
//
// Precondition: the mesh is closed (edges.h) and has no caps. Points and the order of triangles stay; new points come
// last (tests/segment/sample/refine_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Splits up to `count` edges in their middles, the longest first, no two of them of one triangle. Each split replaces
// each of the two triangles at the edge by two, at its place in the order. Returns the number of edges split: `count`,
// if that is at most a sixth of the triangles. O(n log n) for n triangles.
std::size_t split_longest_edges(TriangleMesh& mesh, std::size_t count);

}  // namespace qchopper
