// Pairs the opposite half-edges of a mesh, and counts the edges that keep it from being closed.
//
// Half-edge 3*t+k runs from corner k of triangle t to corner (k+1)%3. Twins are mutual, and the mesh is closed exactly
// if every half-edge has one (tests/segment/mesh/connectivity/edges_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

// The edges that keep a mesh from being closed. All counts are of undirected edges.
struct EdgeFaults {
    std::size_t open = 0;              // one half-edge only
    std::size_t inconsistent = 0;      // two half-edges of the same direction
    std::size_t non_manifold = 0;      // three half-edges or more
    std::uint32_t first_triangle = 0;  // a triangle at the first of these edges, to report where; 0 if there is none
    bool operator==(const EdgeFaults&) const = default;
    bool is_closed() const { return open == 0 && inconsistent == 0 && non_manifold == 0; }
};

struct Edges {
    std::vector<std::uint32_t> twin;  // one per half-edge: the opposite one, or no_twin at an edge that is in `faults`
    EdgeFaults faults;
};
// A half-edge from a point to itself has no twin and counts as a fault. Precondition: the mesh is consistent and has
// fewer than 2^31/3 triangles.
Edges edges(const TriangleMesh& mesh);

}  // namespace qchopper
