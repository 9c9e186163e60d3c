// Orders points and triangles so that neighbours in space are neighbours in memory.
//
// A pass over the mesh that reads the corners of triangles is then two to four times faster. Only the numbering changes
// (tests/segment/mesh/order_test.cpp). Precondition: all coordinates are finite.

#pragma once

#include <cstdint>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::uint32_t triangles_per_cluster = 16;  // at most

// The triangles come in clusters along a Morton curve: each is connected through points. The points come in the order
// of their first triangle; those without a triangle come last, in their old order. Corners and caps stay with their
// triangles.
TriangleMesh in_memory_order(const TriangleMesh& mesh);

}  // namespace qchopper
