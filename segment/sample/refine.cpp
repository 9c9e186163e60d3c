// Edges sorted by length; one whose two triangles are not split yet is split.

#include "segment/sample/refine.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "segment/mesh/connectivity/edges.h"

namespace qchopper {
namespace {

constexpr std::uint32_t whole = no_twin;

// Half-edges of the edges to split, one for each.
std::vector<std::uint32_t> longest(const TriangleMesh& mesh, const Edges& edges, std::size_t count) {
    std::vector<std::pair<double, std::uint32_t>> by_length;  // negative squared length first: the longest in front
    by_length.reserve(edges.twin.size() / 2);
    for (std::uint32_t h = 0; h < edges.twin.size(); ++h) {
        if (h > edges.twin[h]) continue;
        const Triangle& t = mesh.triangles[h / 3];
        const Vec3 along = mesh.points[t[(h % 3 + 1) % 3]] - mesh.points[t[h % 3]];
        by_length.push_back({-dot(along, along), h});
    }
    std::sort(by_length.begin(), by_length.end());
    std::vector<bool> is_taken(mesh.triangles.size());
    std::vector<std::uint32_t> chosen;
    for (const auto& [length, h] : by_length) {
        if (chosen.size() == count) break;
        const std::uint32_t other = edges.twin[h] / 3;
        if (is_taken[h / 3] || is_taken[other]) continue;
        is_taken[h / 3] = is_taken[other] = true;
        chosen.push_back(h);
    }
    return chosen;
}

}  // namespace

std::size_t split_longest_edges(TriangleMesh& mesh, std::size_t count) {
    if (count == 0) return 0;
    assert(mesh.cap_of.empty());
    const Edges found = edges(mesh);
    assert(found.faults.is_closed());
    const std::vector<std::uint32_t> chosen = longest(mesh, found, count);
    std::vector<std::uint32_t> middle(mesh.triangles.size(), whole);
    std::vector<std::uint8_t> side(mesh.triangles.size());  // which of its edges is split
    for (const std::uint32_t h : chosen) {
        const auto point = static_cast<std::uint32_t>(mesh.points.size());
        const Triangle& t = mesh.triangles[h / 3];
        mesh.points.push_back(0.5 * (mesh.points[t[h % 3]] + mesh.points[t[(h % 3 + 1) % 3]]));
        for (const std::uint32_t half_edge : {h, found.twin[h]}) {
            middle[half_edge / 3] = point;
            side[half_edge / 3] = static_cast<std::uint8_t>(half_edge % 3);
        }
    }
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size() + 2 * chosen.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        if (middle[t] == whole) {
            triangles.push_back(old);
            continue;
        }
        const std::uint32_t a = old[side[t]];
        const std::uint32_t b = old[(side[t] + 1) % 3];
        const std::uint32_t c = old[(side[t] + 2) % 3];
        triangles.push_back({a, middle[t], c});
        triangles.push_back({middle[t], b, c});
    }
    mesh.triangles = std::move(triangles);
    return chosen.size();
}

}  // namespace qchopper
