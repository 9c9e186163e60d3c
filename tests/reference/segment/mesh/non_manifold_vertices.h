// Counts the points where surfaces only touch: the reference of links() (segment/mesh/connectivity/links.h) and of
// split_non_manifold_vertices() (segment/mesh/connectivity/manifold.h).

#pragma once

#include <cstddef>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Counts the copies that split_non_manifold_vertices would make, leaving out points at non-manifold or inconsistent
// edges: their fans are not defined. `edges` are those of the mesh.
std::size_t count_non_manifold_vertices(const TriangleMesh& mesh, const Edges& edges);

}  // namespace qchopper
