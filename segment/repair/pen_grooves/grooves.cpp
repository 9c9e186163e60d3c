// Points that are no `none` are grouped along edges; each group is measured by the distance of its points from its rim
// (E. Dijkstra, "A note on two problems in connexion with graphs", 1959). O(n log n) in the points of the mesh.

#include "segment/repair/pen_grooves/grooves.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Neighbours of every point along edges, in one array; each is listed once per triangle of the edge.
struct Neighbours {
    std::vector<std::uint32_t> first;  // per point where its neighbours begin in `all`; one more at the end
    std::vector<std::uint32_t> all;

    explicit Neighbours(const TriangleMesh& mesh) : first(mesh.points.size() + 1, 0) {
        for (const Triangle& t : mesh.triangles) {
            for (const std::uint32_t corner : t) first[corner + 1] += 2;
        }
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        all.resize(first.back());
        std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                all[filled[t[k]]++] = t[(k + 1) % 3];
                all[filled[t[k]]++] = t[(k + 2) % 3];
            }
        }
    }
};

// Per point of a groove the length of the shortest way along edges out of it: to the middle of an edge that leaves it.
std::vector<double> distances_out(const TriangleMesh& mesh, const Neighbours& next,
                                  const std::vector<std::uint8_t>& is_in) {
    std::vector<double> way(mesh.points.size(), 0);
    using Open = std::pair<double, std::uint32_t>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    for (std::uint32_t i = 0; i < way.size(); ++i) {
        if (is_in[i] == 0) continue;
        way[i] = infinite;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            const Vec3 across = mesh.points[i] - mesh.points[next.all[k]];
            if (is_in[next.all[k]] == 0) way[i] = std::min(way[i], 0.5 * norm(across));
        }
        if (way[i] < infinite) open.push({way[i], i});
    }
    while (!open.empty()) {
        const auto [so_far, i] = open.top();
        open.pop();
        if (so_far > way[i]) continue;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            const std::uint32_t j = next.all[k];
            const double longer = so_far + norm(mesh.points[j] - mesh.points[i]);
            if (is_in[j] == 0 || longer >= way[j]) continue;
            way[j] = longer;
            open.push({longer, j});
        }
    }
    return way;
}

// Per point a third of the area of its triangles.
std::vector<double> areas_of(const TriangleMesh& mesh) {
    std::vector<double> areas(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double third = norm(area_vector(mesh, t)) / 3;
        for (const std::uint32_t corner : mesh.triangles[t]) areas[corner] += third;
    }
    return areas;
}

// Connected groups of points that have a seed, in the order of their first points.
std::vector<Groove> groups(const Neighbours& next, const std::vector<GrooveKind>& kinds) {
    DisjointSets sets(kinds.size());
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::none) continue;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            if (kinds[next.all[k]] != GrooveKind::none) sets.unite(i, next.all[k]);
        }
    }
    std::vector<std::uint8_t> has_seed(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::seed) has_seed[sets.root(i)] = 1;
    }
    std::vector<Groove> grooves;
    std::vector<std::uint32_t> number(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::none || has_seed[sets.root(i)] == 0) continue;
        if (sets.root(i) == i) {
            number[i] = static_cast<std::uint32_t>(grooves.size());
            grooves.emplace_back();
        }
        grooves[number[sets.root(i)]].points.push_back(i);
    }
    return grooves;
}

bool is_line(const Groove& groove, const GrooveLimits& limits) {
    constexpr double min_slenderness = 4;
    return groove.depth <= limits.max_depth && groove.width <= limits.max_width && groove.length >= limits.min_length &&
           groove.length >= min_slenderness * groove.width;
}

}  // namespace

std::vector<Groove> line_like_grooves(const TriangleMesh& mesh, const std::vector<GrooveKind>& kinds,
                                      const std::vector<double>& depths, const GrooveLimits& limits) {
    const Neighbours next(mesh);
    const std::vector<double> areas = areas_of(mesh);
    std::vector<std::uint8_t> is_in(kinds.size(), 0);
    for (std::size_t i = 0; i < kinds.size(); ++i) is_in[i] = kinds[i] != GrooveKind::none ? 1 : 0;
    const std::vector<double> way = distances_out(mesh, next, is_in);
    std::vector<Groove> grooves = groups(next, kinds);
    for (Groove& groove : grooves) {
        double weighted = 0;
        for (const std::uint32_t i : groove.points) {
            groove.area_mm2 += areas[i];
            weighted += areas[i] * way[i];
            groove.depth = std::max(groove.depth, depths[i]);
        }
        // The mean distance from the rim of a strip is a quarter of its width.
        groove.width = groove.area_mm2 > 0 ? 4 * weighted / groove.area_mm2 : 0;
        groove.length = groove.width > 0 ? groove.area_mm2 / groove.width : 0;
    }
    std::erase_if(grooves, [&](const Groove& groove) { return !is_line(groove, limits); });
    return grooves;
}

}  // namespace qchopper
