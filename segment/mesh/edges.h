// Which triangles meet at which edge, and whether the mesh is closed.
//
// Half-edge 3*t+k runs from corner k of triangle t to corner (k+1)%3.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

// What stands between a mesh and being closed. All counts are of undirected edges.
struct EdgeFaults {
    std::size_t open = 0;              // one triangle only
    std::size_t inconsistent = 0;      // two triangles that run the edge the same way
    std::size_t non_manifold = 0;      // three triangles or more
    std::uint32_t first_triangle = 0;  // a triangle at the first fault, for "where"
    bool operator==(const EdgeFaults&) const = default;
    bool is_closed() const { return open == 0 && inconsistent == 0 && non_manifold == 0; }
};

// For every half-edge the opposite one, or no_twin at an open, inconsistent or non-manifold edge.
// Linear in the mesh. The mesh must hold fewer than 2^31/3 triangles.
struct Edges {
    std::vector<std::uint32_t> twin;
    EdgeFaults faults;
};
Edges edges(const TriangleMesh& mesh);

}  // namespace qchopper
