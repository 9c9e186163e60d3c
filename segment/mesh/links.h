// What meets at every point of a mesh: which edges are open or non-manifold, and where surfaces only touch.
//
// The answers are those of edges.h and count_non_manifold_vertices in manifold.h, at a fraction of their time and
// memory because nothing is kept of what is sound (tests/segment/mesh/links_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/mesh/edges.h"
#include "segment/mesh/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Links {
    EdgeFaults faults;
    std::vector<std::uint32_t> open;          // half-edges that are the only one of their edge; ascending
    std::vector<std::uint32_t> non_manifold;  // those at edges that are inconsistent or non-manifold; ascending
    // At points where surfaces only touch, every fan but the one of the first triangle, by its corners (a corner has
    // the number of the half-edge that starts there). Points at non-manifold edges are left out: there fans are not
    // known.
    IndexLists extra_fans;
    std::size_t repeated = 0;  // triangles with the same three corners as an earlier one, whichever way they turn
};

// No triangle may have a corner twice (weld.h).
Links links(const TriangleMesh& mesh);

// Gives every extra fan a copy of its point, as split_non_manifold_vertices does.
void split_fans(TriangleMesh& mesh, const IndexLists& extra_fans);

}  // namespace qchopper
