// P. Sander, Z. Wood, S. Gortler, J. Snyder and H. Hoppe, "Multi-chart geometry images" (2003): charts grow from seeds,
// each triangle costing (1 - N.n) times its distance from the one before, with N the normal of the chart; seeds move to
// the middle of their charts until they stay. New seeds are the triangles that are added last.
//
// Ours: the first seed is the triangle farthest from the centroid; every chart that holds a triangle turned by more
// than 40 degrees from it gets a second seed at once, where the paper adds one seed at a time up to a given number; and
// a chart that has none keeps its seed. O(n log n) for n triangles and each of at most 60 rounds.

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "segment/regions/engines/shortest_paths.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr int max_rounds = 60;
constexpr int last_splits = 45;  // rounds after which no chart gets a second seed unless it must

struct Charts {
    std::vector<std::uint32_t> of;    // one per triangle, or no_source
    std::vector<std::uint32_t> last;  // one per chart: the triangle that was added last
};

Charts grown(const FaceGraph& graph, const std::vector<std::uint32_t>& seeds, const std::vector<Vec3>& normals) {
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, chart, triangle
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    Charts charts{std::vector<std::uint32_t>(graph.size(), no_source), seeds};
    for (std::uint32_t c = 0; c < seeds.size(); ++c) queue.emplace(0, c, seeds[c]);
    while (!queue.empty()) {
        const auto [cost, chart, face] = queue.top();
        queue.pop();
        if (charts.of[face] != no_source) continue;
        charts.of[face] = chart;
        charts.last[chart] = face;
        for (const std::uint32_t e : graph.around[face]) {
            if (e == no_dual_edge) continue;
            const std::uint32_t next = graph.across(e, face);
            if (charts.of[next] != no_source) continue;
            const double turned = 1 - dot(normals[chart], graph.normal[next]);
            queue.emplace(cost + std::max(0.0, turned) * norm(graph.centroid[next] - graph.centroid[face]), chart,
                          next);
        }
    }
    return charts;
}

std::vector<Vec3> chart_normals(const FaceGraph& graph, const Charts& charts) {
    std::vector<Vec3> sum(charts.last.size());
    for (std::size_t f = 0; f < graph.size(); ++f) {
        if (charts.of[f] != no_source) sum[charts.of[f]] = sum[charts.of[f]] + graph.area[f] * graph.normal[f];
    }
    for (Vec3& n : sum) n = normalized(n);
    return sum;
}

// Charts with a triangle turned too far from their normal.
std::vector<bool> bent(const FaceGraph& graph, const Charts& charts, const std::vector<Vec3>& normals) {
    const double least = std::cos(max_chart_turn);
    std::vector<bool> is_bent(normals.size(), false);
    for (std::size_t f = 0; f < graph.size(); ++f) {
        const std::uint32_t c = charts.of[f];
        if (c != no_source && graph.area[f] > 0 && dot(graph.normal[f], normals[c]) < least) is_bent[c] = true;
    }
    return is_bent;
}

// The triangle of each chart farthest from its border; charts without a border keep their seed.
std::vector<std::uint32_t> middles(const FaceGraph& graph, const WeightedGraph& paths, const Charts& charts,
                                   std::vector<std::uint32_t> seeds) {
    std::vector<std::uint32_t> border;
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
        const bool is_at_border = std::ranges::any_of(graph.around[f], [&](std::uint32_t e) {
            return e == no_dual_edge || charts.of[graph.across(e, f)] != charts.of[f];
        });
        if (is_at_border) border.push_back(f);
    }
    for (const std::uint32_t f : shortest_paths(paths, border, charts.of).order) {
        if (charts.of[f] != no_source) seeds[charts.of[f]] = f;
    }
    return seeds;
}

// A first seed in each connected part of the surface.
std::vector<std::uint32_t> first_seeds(const FaceGraph& graph) {
    const Labels parts = connected(graph, Labels{std::vector<std::uint32_t>(graph.size(), 0), 1});
    const Vec3 centre = surface_centroid(graph);
    std::vector<std::uint32_t> seeds(parts.count, no_source);
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
        std::uint32_t& seed = seeds[parts.of[f]];
        if (seed == no_source || norm(graph.centroid[f] - centre) > norm(graph.centroid[seed] - centre)) seed = f;
    }
    return seeds;
}

}  // namespace

Labels sander_charts(const FaceGraph& graph, const RegionOptions& options) {
    std::vector<double> cost;
    for (const DualEdge& edge : graph.edges) cost.push_back(edge.path);
    const WeightedGraph paths = weighted_faces(graph, cost);
    std::vector<std::uint32_t> seeds = first_seeds(graph);
    std::vector<Vec3> normals;
    normals.reserve(seeds.size());
    for (const std::uint32_t s : seeds) normals.push_back(graph.normal[s]);
    Charts charts;
    for (int round = 0; round < max_rounds; ++round) {
        charts = grown(graph, seeds, normals);
        normals = chart_normals(graph, charts);
        const std::vector<bool> is_bent = bent(graph, charts, normals);
        const bool may_split = options.regions == 0 || seeds.size() < options.regions;
        std::vector<std::uint32_t> next = round < last_splits ? middles(graph, paths, charts, seeds) : seeds;
        for (std::size_t c = 0; may_split && c < is_bent.size(); ++c) {
            if (!is_bent[c] || charts.last[c] == next[c]) continue;
            if (options.regions > 0 && next.size() == options.regions) break;
            next.push_back(charts.last[c]);
            normals.push_back(graph.normal[charts.last[c]]);
        }
        if (next == seeds) break;
        seeds = std::move(next);
    }
    return connected(graph, numbered(charts.of));
}

}  // namespace qchopper
