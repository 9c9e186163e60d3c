// Puts points and triangles in an order in which neighbours in space are neighbours in memory.
//
// Every pass over a mesh that looks up corners is two to four times faster so. The same shape comes out: only the
// numbering changes (tests/segment/mesh/order_test.cpp).

#pragma once

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Points along a Morton curve (Morton 1966), triangles by their smallest point; both ties by their old number.
TriangleMesh in_memory_order(const TriangleMesh& mesh);

}  // namespace qchopper
