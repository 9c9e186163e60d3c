#include "segment/repair/dents.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "segment/mesh/disjoint_sets.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Neighbours of every point along edges, all in one row.
struct Neighbours {
    std::vector<std::uint32_t> first;  // per point, and one more
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

// Way along edges from every point of a dent out of it (Dijkstra 1959): to the middle of an edge that leaves it.
std::vector<double> ways_out(const TriangleMesh& mesh, const Neighbours& next, const std::vector<std::uint8_t>& is_in) {
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

// A third of the area of the triangles around.
std::vector<double> areas_of(const TriangleMesh& mesh) {
    std::vector<double> areas(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double third = norm(area_vector(mesh, t)) / 3;
        for (const std::uint32_t corner : mesh.triangles[t]) areas[corner] += third;
    }
    return areas;
}

// Groups of points that hang together, those without a seed left out; in the order of their first points.
std::vector<Dent> groups(const Neighbours& next, const std::vector<DentKind>& kinds) {
    DisjointSets sets(kinds.size());
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == DentKind::none) continue;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            if (kinds[next.all[k]] != DentKind::none) sets.unite(i, next.all[k]);
        }
    }
    std::vector<std::uint8_t> has_seed(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == DentKind::seed) has_seed[sets.root(i)] = 1;
    }
    std::vector<Dent> dents;
    std::vector<std::uint32_t> number(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == DentKind::none || has_seed[sets.root(i)] == 0) continue;
        if (sets.root(i) == i) {
            number[i] = static_cast<std::uint32_t>(dents.size());
            dents.emplace_back();
        }
        dents[number[sets.root(i)]].points.push_back(i);
    }
    return dents;
}

bool is_line(const Dent& dent, const DentLimits& limits) {
    constexpr double least_slenderness = 4;
    return dent.depth <= limits.most_depth && dent.width <= limits.most_width && dent.length >= limits.least_length &&
           dent.length >= least_slenderness * dent.width;
}

}  // namespace

std::vector<Dent> line_like_dents(const TriangleMesh& mesh, const std::vector<DentKind>& kinds,
                                  const std::vector<double>& depths, const DentLimits& limits) {
    const Neighbours next(mesh);
    const std::vector<double> areas = areas_of(mesh);
    std::vector<std::uint8_t> is_in(kinds.size(), 0);
    for (std::size_t i = 0; i < kinds.size(); ++i) is_in[i] = kinds[i] != DentKind::none ? 1 : 0;
    const std::vector<double> way = ways_out(mesh, next, is_in);
    std::vector<Dent> dents = groups(next, kinds);
    for (Dent& dent : dents) {
        double weighted = 0;
        for (const std::uint32_t i : dent.points) {
            dent.area_mm2 += areas[i];
            weighted += areas[i] * way[i];
            dent.depth = std::max(dent.depth, depths[i]);
        }
        // Across a strip the way out is a quarter of its width on the average.
        dent.width = dent.area_mm2 > 0 ? 4 * weighted / dent.area_mm2 : 0;
        dent.length = dent.width > 0 ? dent.area_mm2 / dent.width : 0;
    }
    std::erase_if(dents, [&](const Dent& dent) { return !is_line(dent, limits); });
    return dents;
}

}  // namespace qchopper
