// S. Katz and A. Tal, "Hierarchical mesh decomposition using fuzzy clustering and cuts" (2003): k representatives; what
// is nearly as near to a second as to the first is fuzzy, and is divided by a minimum cut through concave edges.
//
// Of the paper: the distance of neighbours, with eta = 0.15 for convex edges; k where the gap of the representatives
// falls most; membership d2 / (d1 + d2); the capacity 1 / (1 + angle / mean angle) of an edge. Ours: k ways at once,
// one level deep, where the thesis tells of halves; distances to representatives, not to all triangles; the first
// representative is nearest to the centroid; angles of smoothed normals. O(k n log n) for n triangles, and the cuts.

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "segment/regions/engines/bends.h"
#include "segment/regions/engines/minimum_cut.h"
#include "segment/regions/engines/representatives.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double fuzzy_below = 0.65;  // membership
constexpr std::size_t most_regions = 20;
constexpr int rounds = 8;

// The nearest and the second nearest representative of each triangle.
struct Memberships {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> second;  // equal to the first where that is sure
};

Memberships memberships(const WeightedGraph& graph, const Grouping& groups) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::vector<double> least(graph.size(), infinite);
    std::vector<double> next(graph.size(), infinite);
    Memberships found{groups.of, groups.of};
    for (std::uint32_t r = 0; r < groups.representative.size(); ++r) {
        const ShortestPaths paths = shortest_paths(graph, std::span(&groups.representative[r], 1));
        for (std::size_t f = 0; f < graph.size(); ++f) {
            if (groups.of[f] == r) {
                least[f] = paths.cost[f];
            } else if (paths.cost[f] < next[f]) {
                next[f] = paths.cost[f];
                found.second[f] = r;
            }
        }
    }
    for (std::size_t f = 0; f < graph.size(); ++f) {
        if (!(next[f] < infinite) || next[f] >= fuzzy_below * (next[f] + least[f])) found.second[f] = found.first[f];
    }
    return found;
}

// Divides the fuzzy triangles of two groups; those of the groups around them are the ends of the cut.
void cut_between(const FaceGraph& graph, const std::vector<double>& capacity, const Memberships& members,
                 const std::vector<std::uint32_t>& fuzzy, std::vector<std::uint32_t>& of) {
    std::map<std::uint32_t, std::uint32_t> number;
    const auto numbered_as = [&](std::uint32_t f) {
        return number.try_emplace(f, static_cast<std::uint32_t>(number.size())).first->second;
    };
    const auto [a, b] = std::minmax(members.first[fuzzy.front()], members.second[fuzzy.front()]);
    for (const std::uint32_t f : fuzzy) numbered_as(f);
    std::vector<CutEdge> edges;
    std::vector<std::uint32_t> sources;
    std::vector<std::uint32_t> sinks;
    for (const std::uint32_t f : fuzzy) {
        const std::uint32_t i = number.at(f);
        for (const std::uint32_t e : graph.around[f]) {
            if (e == no_dual_edge) continue;
            const std::uint32_t other = graph.across(e, f);
            const bool is_fuzzy = number.contains(other) && number.at(other) < fuzzy.size();
            if (is_fuzzy && other < f) continue;
            if (!is_fuzzy && members.first[other] != a && members.first[other] != b) continue;
            if (!is_fuzzy && !number.contains(other)) {
                (members.first[other] == a ? sources : sinks).push_back(numbered_as(other));
            }
            edges.push_back({i, number.at(other), capacity[e]});
        }
    }
    if (sources.empty() || sinks.empty()) return;
    const MinimumCut cut = minimum_cut(number.size(), edges, sources, sinks);
    for (const std::uint32_t f : fuzzy) of[f] = cut.is_with_sources[number.at(f)] ? a : b;
}

std::vector<double> capacities(const FaceGraph& graph) {
    std::vector<double> capacity = angular_distances(graph);
    const double sum = std::accumulate(capacity.begin(), capacity.end(), 0.0);
    const double mean = capacity.empty() ? 0 : sum / static_cast<double>(capacity.size());
    for (double& c : capacity) c = 1 / (1 + (mean > 0 ? c / mean : 0));
    return capacity;
}

}  // namespace

Labels katz_tal_parts(const FaceGraph& graph, const RegionOptions& options) {
    const WeightedGraph weighted = weighted_faces(graph, neighbour_distances(graph));
    const std::size_t most = options.regions > 0 ? options.regions : most_regions + 1;
    Representatives found = farthest_first(weighted, nearest_face(graph, surface_centroid(graph)), most);
    if (options.regions == 0) found.element.resize(count_at_largest_fall(found.gap));
    const Grouping groups = grouped(weighted, graph.area, graph.centroid, found.element, rounds);
    const Memberships members = memberships(weighted, groups);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> fuzzy;
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
        if (members.first[f] != members.second[f]) fuzzy[std::minmax(members.first[f], members.second[f])].push_back(f);
    }
    const std::vector<double> capacity = capacities(graph);
    std::vector<std::uint32_t> of = groups.of;
    for (const auto& [pair, faces] : fuzzy) cut_between(graph, capacity, members, faces, of);
    return connected(graph, numbered(of));
}

}  // namespace qchopper
