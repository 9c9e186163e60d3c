// Takes triangles out of a closed mesh where they tell least of its shape.
//
// Points that stay do not move. The mesh stays closed and manifold, keeps its handles, and never comes to meet itself
// (tests/segment/sample/thin_out_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Collapses edges until `target` triangles are left, or until no edge can be collapsed any more.
void thin_out(TriangleMesh& mesh, std::size_t target, const Context& context);

}  // namespace qchopper
