#include "segment/repair/edge_groups.h"

#include <algorithm>

#include "segment/repair/manifold.h"

namespace qchopper {

EdgeGroups edge_groups(const TriangleMesh& mesh) {
    const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    const auto low = [&](std::uint32_t h) { return std::min(start_of(mesh, h), end_of(mesh, h)); };
    const auto high = [&](std::uint32_t h) { return std::max(start_of(mesh, h), end_of(mesh, h)); };
    std::vector<std::uint32_t> first(mesh.points.size() + 2, 0);  // counting sort by the smaller end point
    for (std::uint32_t h = 0; h < count; ++h) ++first[low(h) + 2];
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    EdgeGroups groups;
    groups.half_edges.resize(count);
    for (std::uint32_t h = 0; h < count; ++h) groups.half_edges[first[low(h) + 1]++] = h;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const auto begin = groups.half_edges.begin() + first[v];
        const auto end = groups.half_edges.begin() + first[v + 1];
        std::sort(begin, end,
                  [&](std::uint32_t a, std::uint32_t b) { return high(a) != high(b) ? high(a) < high(b) : a < b; });
        for (auto at = begin; at != end; ++at) {
            if (at != begin && high(*at) == high(*(at - 1))) continue;
            groups.begin.push_back(static_cast<std::uint32_t>(at - groups.half_edges.begin()));
        }
    }
    groups.begin.push_back(count);
    return groups;
}

}  // namespace qchopper
