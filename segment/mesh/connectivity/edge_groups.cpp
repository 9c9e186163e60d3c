// Counting sort by the smaller end point, then a sort of the few half-edges of each point by the larger one.
// O(triangles + points) while each point has few edges; around_edge is O(k log k) for k half-edges.

#include "segment/mesh/connectivity/edge_groups.h"

#include <algorithm>
#include <cmath>

#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {

IndexLists edge_groups(const TriangleMesh& mesh) {
    const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    const auto low = [&](std::uint32_t h) { return std::min(start_of(mesh, h), end_of(mesh, h)); };
    const auto high = [&](std::uint32_t h) { return std::max(start_of(mesh, h), end_of(mesh, h)); };
    std::vector<std::uint32_t> first(mesh.points.size() + 2, 0);  // counting sort by the smaller end point
    for (std::uint32_t h = 0; h < count; ++h) ++first[low(h) + 2];
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    IndexLists groups;
    groups.values.resize(count);
    for (std::uint32_t h = 0; h < count; ++h) groups.values[first[low(h) + 1]++] = h;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const auto begin = groups.values.begin() + first[v];
        const auto end = groups.values.begin() + first[v + 1];
        std::sort(begin, end,
                  [&](std::uint32_t a, std::uint32_t b) { return high(a) != high(b) ? high(a) < high(b) : a < b; });
        for (auto at = begin; at != end; ++at) {
            if (at + 1 != end && high(*at) == high(*(at + 1))) continue;
            groups.first.push_back(static_cast<std::uint32_t>(at + 1 - groups.values.begin()));
        }
    }
    return groups;
}

std::vector<AtAngle> around_edge(const TriangleMesh& mesh, std::span<const std::uint32_t> group) {
    const std::uint32_t a = std::min(start_of(mesh, group[0]), end_of(mesh, group[0]));
    const std::uint32_t b = std::max(start_of(mesh, group[0]), end_of(mesh, group[0]));
    const Vec3 axis = normalized(mesh.points[b] - mesh.points[a]);
    const auto side = [&](std::uint32_t h) {
        const Vec3 d = mesh.points[mesh.triangles[h / 3][(h % 3 + 2) % 3]] - mesh.points[a];
        return d - dot(axis, d) * axis;
    };
    const Vec3 u = normalized(side(group[0]));
    const Vec3 v = cross(axis, u);
    std::vector<AtAngle> sorted;
    for (const std::uint32_t h : group) {
        const Vec3 d = side(h);
        const double angle = h == group[0] ? 0 : std::atan2(dot(v, d), dot(u, d));
        sorted.push_back({std::isfinite(angle) ? angle : 0, h});  // the squares of its lengths overflow
    }
    std::sort(sorted.begin(), sorted.end(), [](const AtAngle& x, const AtAngle& y) {
        return x.angle != y.angle ? x.angle < y.angle : x.half_edge < y.half_edge;
    });
    return sorted;
}

}  // namespace qchopper
