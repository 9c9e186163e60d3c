// Points where surfaces only touch, and the border loops of an open mesh.
//
// A point is non-manifold when the triangles around it fall into several fans that share no edge there. After
// split_non_manifold_vertices every fan has a point of its own, so no border loop touches another
// (tests/segment/mesh/manifold_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/edges.h"
#include "segment/mesh/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Counts the copies that split_non_manifold_vertices would make, leaving out points at non-manifold or inconsistent
// edges: there the fans are not known.
std::size_t count_non_manifold_vertices(const TriangleMesh& mesh, const Edges& edges);

// The fan of the first triangle keeps the point, every other fan gets a copy of it at the end of the points.
// Triangles keep their order. Returns the number of copies.
std::size_t split_non_manifold_vertices(TriangleMesh& mesh, const Edges& edges);

// The half-edges without a twin: at the border of the surface, or at an edge that is non-manifold or inconsistent.
struct Unpaired {
    std::vector<std::uint32_t> open;          // the only half-edge of its edge; ascending
    std::vector<std::uint32_t> non_manifold;  // ascending
};
Unpaired unpaired(const TriangleMesh& mesh, const Edges& edges);

// The open border as loops of half-edges, each loop in the order in which triangles that fill it would run backwards
// along them: the start of one is the end of the next. Meant for a mesh without non-manifold vertices and non-manifold
// edges; with them a loop ends where the way is not clear.
IndexLists border_loops(const TriangleMesh& mesh, std::span<const std::uint32_t> open);

// Mean of the points of a loop.
Vec3 centre_of(const TriangleMesh& mesh, std::span<const std::uint32_t> loop);

inline std::uint32_t start_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
    return mesh.triangles[half_edge / 3][half_edge % 3];
}
inline std::uint32_t end_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
    return mesh.triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
}

}  // namespace qchopper
