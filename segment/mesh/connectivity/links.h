// Checks the link of every point of a mesh: which edges are open or non-manifold, and where surfaces only touch.
//
// The results equal those of edges.h and manifold.h at a fraction of their time and memory, because no twin of a
// manifold edge is stored (tests/segment/mesh/connectivity/links_test.cpp). O(triangles + points) while
// each point has few triangles; 4 bytes per corner.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Links {
    EdgeFaults faults;
    std::vector<std::uint32_t> open;          // half-edges that are the only one of their edge; ascending
    std::vector<std::uint32_t> non_manifold;  // those at edges that are inconsistent or non-manifold; ascending
    // One list per fan at points where surfaces only touch, but for the fan of the first triangle there: its corners (a
    // corner has the number of the half-edge that starts there). Points at non-manifold or inconsistent edges are left
    // out: their fans are not defined.
    IndexLists extra_fans;
    std::size_t repeated = 0;  // triangles with the same three corners as an earlier one, of either orientation
};

// Precondition: no triangle has a corner twice (repair/weld.h drops those).
Links links(const TriangleMesh& mesh);

// Gives every extra fan a copy of its point, at the end of the points, as split_non_manifold_vertices does.
// `extra_fans` are those of links(mesh).
void split_fans(TriangleMesh& mesh, const IndexLists& extra_fans);

}  // namespace qchopper
