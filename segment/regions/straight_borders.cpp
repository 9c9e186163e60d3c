// A path is found by Dijkstra's algorithm over the points that lie inside the two regions, as far as its other end; the
// triangles on its sides are found by growth that does not cross it, over both regions: O(n) for each part of a border
// that is moved, n the triangles of its regions, with marks that are cleared behind it.

#include "segment/regions/straight_borders.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "segment/regions/borders.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double least_gain = 1e-9;  // of the length

using Edges = std::vector<std::uint32_t>;  // dual edges

double length_of(const FaceGraph& graph, const Edges& edges) {
    double length = 0;
    for (const std::uint32_t e : edges) length += graph.edges[e].length;
    return length;
}

// The ends of edges that are one open path; nothing if they are anything else.
std::optional<std::array<std::uint32_t, 2>> ends_of(const FaceGraph& graph, const Edges& edges) {
    std::map<std::uint32_t, int> degree;
    for (const std::uint32_t e : edges) {
        for (const std::uint32_t p : graph.edges[e].point) ++degree[p];
    }
    std::vector<std::uint32_t> ends;
    for (const auto& [point, count] : degree) {
        if (count > 2) return std::nullopt;
        if (count == 1) ends.push_back(point);
    }
    if (ends.size() != 2) return std::nullopt;
    return std::array{ends[0], ends[1]};
}

class Straightener {
 public:
    Straightener(const FaceGraph& graph, const Labels& labels)
        : graph_(graph),
          of_(labels.of),
          faces_(labels.count),
          at_(graph.mesh->points.size()),
          is_barrier_(graph.edges.size(), false),
          side_(graph.size(), no_side) {
        for (std::uint32_t f = 0; f < graph.size(); ++f) faces_[of_[f]].push_back(f);
        for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
            for (const std::uint32_t p : graph.edges[e].point) at_[p].push_back(e);
        }
    }

    // The parts of the border between its sharp edges, each by itself.
    void straighten(const RegionBorder& border) {
        RegionBorder movable{border.region, {}};
        for (const std::uint32_t e : border.edges) {
            if (graph_.edges[e].turn < max_chart_turn) movable.edges.push_back(e);
        }
        for (const RegionBorder& part : connected_parts(graph_, movable)) straighten_path(part);
    }

    const std::vector<std::uint32_t>& of() const { return of_; }

 private:
    bool is_of(const RegionBorder& border, std::uint32_t face) const {
        return of_[face] == border.region[0] || of_[face] == border.region[1];
    }

    // Whether all triangles at the edge, and those at its point, are of the two regions.
    bool is_inside(const RegionBorder& border, std::uint32_t edge) const {
        return std::ranges::all_of(graph_.edges[edge].face, [&](std::uint32_t f) { return is_of(border, f); });
    }
    bool is_point_inside(const RegionBorder& border, std::uint32_t point) const {
        return std::ranges::all_of(at_[point], [&](std::uint32_t e) { return is_inside(border, e); });
    }

    void straighten_path(const RegionBorder& border) {
        const auto ends = ends_of(graph_, border.edges);
        if (!ends) return;
        // Borders before this one may have moved it.
        const auto is_still_there = [&](std::uint32_t e) {
            const auto [f, g] = graph_.edges[e].face;
            return std::minmax(of_[f], of_[g]) == std::minmax(border.region[0], border.region[1]);
        };
        if (!std::ranges::all_of(border.edges, is_still_there)) return;
        const Edges path = shortest(border, *ends);
        if (path.empty() || length_of(graph_, path) > (1 - least_gain) * length_of(graph_, border.edges)) return;
        divide(border, path);
    }

    // Empty: there is none.
    Edges shortest(const RegionBorder& border, const std::array<std::uint32_t, 2>& ends) const {
        using Entry = std::pair<double, std::uint32_t>;
        std::map<std::uint32_t, std::pair<double, std::uint32_t>> best;  // cost, and the edge that led there
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        best[ends[0]] = {0, no_dual_edge};
        queue.emplace(0, ends[0]);
        while (!queue.empty()) {
            const auto [cost, point] = queue.top();
            queue.pop();
            if (cost > best.at(point).first) continue;
            if (point == ends[1]) break;
            if (point != ends[0] && !is_point_inside(border, point)) continue;
            for (const std::uint32_t e : at_[point]) {
                if (!is_inside(border, e)) continue;
                const auto [p, q] = graph_.edges[e].point;
                const std::uint32_t next = p == point ? q : p;
                const double there = cost + graph_.edges[e].length;
                const auto known = best.find(next);
                if (known != best.end() && !(there < known->second.first)) continue;
                best[next] = {there, e};
                queue.emplace(there, next);
            }
        }
        Edges path;
        for (std::uint32_t at = ends[1]; at != ends[0] && best.contains(at);) {
            path.push_back(best.at(at).second);
            const auto [p, q] = graph_.edges[path.back()].point;
            at = p == at ? q : p;
        }
        return path;
    }

    // The edges that no side may grow across: the path, and other borders between the two regions, which keep what is
    // on their sides apart.
    Edges barrier_of(const RegionBorder& border, const Edges& path, const std::vector<std::uint32_t>& faces) const {
        Edges barrier = path;
        for (const std::uint32_t f : faces) {
            for (const std::uint32_t e : graph_.around[f]) {
                if (e == no_dual_edge || !is_inside(border, e)) continue;
                const auto [a, b] = graph_.edges[e].face;
                if (of_[a] != of_[b] && !std::ranges::binary_search(border.edges, e)) barrier.push_back(e);
            }
        }
        return barrier;
    }

    // Gives each side of the path to the region of which it had more, if that leaves both connected.
    void divide(const RegionBorder& border, const Edges& path) {
        std::vector<std::uint32_t> all = faces_[border.region[0]];
        all.insert(all.end(), faces_[border.region[1]].begin(), faces_[border.region[1]].end());
        const Edges barrier = barrier_of(border, path, all);
        for (const std::uint32_t e : barrier) is_barrier_[e] = true;
        give_sides(border, all);
        for (const std::uint32_t e : barrier) is_barrier_[e] = false;
        for (const std::uint32_t f : all) side_[f] = no_side;
    }

    void give_sides(const RegionBorder& border, const std::vector<std::uint32_t>& all) {
        std::vector<std::array<double, 2>> areas;  // of each side, by the region that it had
        for (const std::uint32_t first : all) {
            if (side_[first] != no_side) continue;
            areas.push_back(grow_side(border, first, static_cast<std::uint32_t>(areas.size())));
        }
        if (areas.size() != 2) return;
        const bool is_first_of_0 = areas[0][0] >= areas[0][1];
        if (is_first_of_0 == (areas[1][0] >= areas[1][1])) return;
        faces_[border.region[0]].clear();
        faces_[border.region[1]].clear();
        for (const std::uint32_t f : all) {
            of_[f] = border.region[(side_[f] == 0) == is_first_of_0 ? 0 : 1];
            faces_[of_[f]].push_back(f);
        }
    }

    // What is reached from a triangle without crossing the barrier: its area, by the region that it had.
    std::array<double, 2> grow_side(const RegionBorder& border, std::uint32_t first, std::uint32_t side) {
        std::array<double, 2> area{};
        std::vector<std::uint32_t> faces{first};
        side_[first] = side;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const std::uint32_t f = faces[i];
            area[of_[f] == border.region[0] ? 0 : 1] += graph_.area[f];
            for (const std::uint32_t e : graph_.around[f]) {
                if (e == no_dual_edge || is_barrier_[e]) continue;
                const std::uint32_t next = graph_.across(e, f);
                if (!is_of(border, next) || side_[next] != no_side) continue;
                side_[next] = side;
                faces.push_back(next);
            }
        }
        return area;
    }

    static constexpr std::uint32_t no_side = 0xFFFFFFFF;

    const FaceGraph& graph_;
    std::vector<std::uint32_t> of_;
    std::vector<std::vector<std::uint32_t>> faces_;  // of each region
    std::vector<Edges> at_;                          // the edges at each point
    // Of the border that is divided, cleared behind it: per edge, and per triangle.
    std::vector<bool> is_barrier_;
    std::vector<std::uint32_t> side_;
};

}  // namespace

Labels with_straight_borders(const FaceGraph& graph, const Labels& labels) {
    Straightener straightener(graph, labels);
    for (const RegionBorder& border : region_borders(graph, labels.of)) straightener.straighten(border);
    return numbered(straightener.of());
}

}  // namespace qchopper
