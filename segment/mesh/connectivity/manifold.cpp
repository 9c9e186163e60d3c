// Fans are collected by turning about their point from twin to twin, both ways. Splitting is the local cutting of
// A. Guéziec, G. Taubin, F. Lazarus and W. Horn, "Cutting and stitching: converting sets of polygons to manifold
// surfaces" (2001).

#include "segment/mesh/connectivity/manifold.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Calls on_fan(corners) for every fan: the corners at one point that are connected through edges with twins. Fans come
// in the order of their first corner. A corner has the number of the half-edge that starts there.
template <class OnFan>
void for_each_fan(const TriangleMesh& mesh, const Edges& edges, const OnFan& on_fan) {
    std::vector<bool> done(3 * mesh.triangles.size());
    std::vector<std::uint32_t> fan;
    for (std::uint32_t first = 0; first < done.size(); ++first) {
        if (done[first]) continue;
        fan.clear();
        const auto add = [&](std::uint32_t corner) {
            done[corner] = true;
            fan.push_back(corner);
        };
        add(first);
        for (std::uint32_t twin = edges.twin[first]; twin != no_twin;) {
            const std::uint32_t corner = next_in_triangle(twin);
            if (done[corner]) break;
            add(corner);
            twin = edges.twin[corner];
        }
        for (std::uint32_t twin = edges.twin[previous_in_triangle(first)]; twin != no_twin;) {
            if (done[twin]) break;
            add(twin);
            twin = edges.twin[previous_in_triangle(twin)];
        }
        on_fan(fan);
    }
}

}  // namespace

std::size_t split_non_manifold_vertices(TriangleMesh& mesh, const Edges& edges) {
    std::vector<bool> has_fan(mesh.points.size());
    const std::size_t before = mesh.points.size();
    for_each_fan(mesh, edges, [&](const std::vector<std::uint32_t>& fan) {
        const std::uint32_t point = start_of(mesh, fan.front());
        if (!has_fan[point]) {
            has_fan[point] = true;
            return;
        }
        const auto copy = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(Vec3(mesh.points[point]));
        for (const std::uint32_t corner : fan) mesh.triangles[corner / 3][corner % 3] = copy;
    });
    return mesh.points.size() - before;
}

Unpaired unpaired(const TriangleMesh& mesh, const Edges& edges) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<std::pair<Edge, std::uint32_t>> without_twin;
    for (std::uint32_t h = 0; h < edges.twin.size(); ++h) {
        if (edges.twin[h] != no_twin) continue;
        const std::uint32_t a = start_of(mesh, h);
        const std::uint32_t b = end_of(mesh, h);
        without_twin.push_back({{std::min(a, b), std::max(a, b)}, h});
    }
    std::sort(without_twin.begin(), without_twin.end());
    Unpaired result;
    for (std::size_t i = 0; i < without_twin.size(); ++i) {
        const bool has_same_before = i > 0 && without_twin[i - 1].first == without_twin[i].first;
        const bool has_same_after = i + 1 < without_twin.size() && without_twin[i + 1].first == without_twin[i].first;
        (has_same_before || has_same_after ? result.non_manifold : result.open).push_back(without_twin[i].second);
    }
    std::sort(result.open.begin(), result.open.end());
    std::sort(result.non_manifold.begin(), result.non_manifold.end());
    return result;
}

IndexLists border_loops(const TriangleMesh& mesh, std::span<const std::uint32_t> open) {
    std::vector<std::uint32_t> ends_at(mesh.points.size(), none);  // the open half-edge that ends at a point
    for (const std::uint32_t h : open) ends_at[end_of(mesh, h)] = h;
    IndexLists loops;
    std::vector<bool> done(3 * mesh.triangles.size());
    for (const std::uint32_t first : open) {
        if (done[first]) continue;
        for (std::uint32_t h = first; h != none && !done[h]; h = ends_at[start_of(mesh, h)]) {
            done[h] = true;
            loops.values.push_back(h);
        }
        loops.end_list();
    }
    return loops;
}

Vec3 centre_of(const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    Vec3 sum;
    for (const std::uint32_t h : loop) sum = sum + mesh.points[start_of(mesh, h)];
    return (1.0 / static_cast<double>(loop.size())) * sum;
}

}  // namespace qchopper
