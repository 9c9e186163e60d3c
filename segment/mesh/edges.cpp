#include "segment/mesh/edges.h"

#include <algorithm>
#include <cassert>

namespace qchopper {
namespace {

// A half-edge seen from the smaller of its two end points.
struct HalfEdge {
    std::uint32_t other;  // the larger end point
    std::uint32_t id;
    bool operator<(const HalfEdge& b) const { return other != b.other ? other < b.other : id < b.id; }
};

}  // namespace

Edges edges(const TriangleMesh& mesh) {
    assert(mesh.triangles.size() < no_twin / 3);
    const auto half_edge_count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    const auto ends = [&](std::uint32_t id) {
        const Triangle& t = mesh.triangles[id / 3];
        return std::pair{t[id % 3], t[(id + 1) % 3]};
    };
    std::vector<std::uint32_t> first(mesh.points.size() + 2, 0);  // counting sort by the smaller end point
    for (std::uint32_t id = 0; id < half_edge_count; ++id) {
        const auto [a, b] = ends(id);
        ++first[std::min(a, b) + 2];
    }
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<HalfEdge> sorted(half_edge_count);
    for (std::uint32_t id = 0; id < half_edge_count; ++id) {
        const auto [a, b] = ends(id);
        sorted[first[std::min(a, b) + 1]++] = {std::max(a, b), id};
    }
    Edges result;
    result.twin.assign(half_edge_count, no_twin);
    EdgeFaults& faults = result.faults;
    const auto fault_at = [&](std::uint32_t id) {
        if (faults.is_closed()) faults.first_triangle = id / 3;
    };
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const auto begin = sorted.begin() + first[v];
        const auto end = sorted.begin() + first[v + 1];
        std::sort(begin, end);
        for (auto group = begin; group != end;) {
            auto next = group;
            while (next != end && next->other == group->other) ++next;
            const auto size = next - group;
            const std::uint32_t a = group->id;
            if (size == 2 && ends(a).first == ends((group + 1)->id).second && group->other != v) {
                result.twin[a] = (group + 1)->id;
                result.twin[(group + 1)->id] = a;
            } else {
                fault_at(a);
                ++(size == 1 ? faults.open : size == 2 ? faults.inconsistent : faults.non_manifold);
            }
            group = next;
        }
    }
    return result;
}

}  // namespace qchopper
