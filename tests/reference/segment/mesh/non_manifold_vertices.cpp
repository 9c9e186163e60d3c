// Corners of one point that an edge joins are united; each set but the first of a point is a copy.

#include "tests/reference/segment/mesh/non_manifold_vertices.h"

#include <cstdint>
#include <vector>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {

std::size_t count_non_manifold_vertices(const TriangleMesh& mesh, const Edges& edges) {
    const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    DisjointSets fans(corners);
    for (std::uint32_t h = 0; h < corners; ++h) {
        const std::uint32_t twin = edges.twin[h];
        // The half-edge after the twin starts where h does.
        if (twin != no_twin) fans.unite(h, twin % 3 == 2 ? twin - 2 : twin + 1);
    }
    std::vector<bool> is_left_out(mesh.points.size());
    for (const std::uint32_t h : unpaired(mesh, edges).non_manifold) {
        is_left_out[start_of(mesh, h)] = true;
        is_left_out[end_of(mesh, h)] = true;
    }
    std::vector<bool> has_fan(mesh.points.size());
    std::size_t copies = 0;
    for (std::uint32_t h = 0; h < corners; ++h) {
        const std::uint32_t point = start_of(mesh, h);
        if (fans.root(h) != h || is_left_out[point]) continue;
        copies += has_fan[point] ? 1 : 0;
        has_fan[point] = true;
    }
    return copies;
}

}  // namespace qchopper
