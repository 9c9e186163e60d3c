// Adds triangles to a closed mesh without changing its shape.
//
// (tests/segment/sample/refine_test.cpp)

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Splits `count` edges in their middles, the longest first, no two of them of one triangle; each split adds two
// triangles next to the ones they come from. Returns how many edges could be split: up to a third of the triangles
// can be counted on.
std::size_t split_longest_edges(TriangleMesh& mesh, std::size_t count);

}  // namespace qchopper
