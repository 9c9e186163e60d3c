// Finds and splits points where surfaces only touch, and follows the border loops of an open mesh.
//
// A point is non-manifold when the triangles around it form several fans that share no edge there. After
// split_non_manifold_vertices every fan has a point of its own, so no border loop touches another
// (tests/segment/mesh/connectivity/manifold_test.cpp). Half-edges are numbered as in edges.h, and `edges` are always
// those of the mesh. O(triangles + points), unpaired O(u log u) more for u half-edges without a twin.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The fan of the first triangle keeps the point, every other fan gets a copy of it at the end of the points.
// Triangles keep their order. Returns the number of copies.
std::size_t split_non_manifold_vertices(TriangleMesh& mesh, const Edges& edges);

// The half-edges without a twin: at the border of the surface, or at an edge that is non-manifold or inconsistent.
struct Unpaired {
    std::vector<std::uint32_t> open;          // the only half-edge of its edge; ascending
    std::vector<std::uint32_t> non_manifold;  // ascending
};
Unpaired unpaired(const TriangleMesh& mesh, const Edges& edges);

// One list of half-edges per loop of the open border: the start of one half-edge is the end of the next, the
// order in which triangles that fill the hole run along them. `open` is Unpaired::open of the mesh. At a non-manifold
// vertex or edge a loop may end early.
IndexLists border_loops(const TriangleMesh& mesh, std::span<const std::uint32_t> open);

// Mean of the points of a loop of half-edges, which is not empty.
Vec3 centre_of(const TriangleMesh& mesh, std::span<const std::uint32_t> loop);

// The half-edges of the same triangle after and before this one.
inline std::uint32_t next_in_triangle(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
inline std::uint32_t previous_in_triangle(std::uint32_t half_edge) {
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

inline std::uint32_t start_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
    return mesh.triangles[half_edge / 3][half_edge % 3];
}
inline std::uint32_t end_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
    return mesh.triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
}

}  // namespace qchopper
