#include "segment/regions/engines/shortest_paths.h"

#include <cassert>
#include <queue>
#include <tuple>

namespace qchopper {
namespace {

struct Undirected {
    std::uint32_t a;
    std::uint32_t b;
    double cost;
};

WeightedGraph graph_of(std::size_t elements, const std::vector<Undirected>& pairs) {
    WeightedGraph graph;
    graph.first.assign(elements + 1, 0);
    for (const Undirected& p : pairs) {
        ++graph.first[p.a + 1];
        ++graph.first[p.b + 1];
    }
    for (std::size_t e = 0; e < elements; ++e) graph.first[e + 1] += graph.first[e];
    graph.arcs.resize(2 * pairs.size());
    std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
    for (const Undirected& p : pairs) {
        graph.arcs[next[p.a]++] = {p.b, p.cost};
        graph.arcs[next[p.b]++] = {p.a, p.cost};
    }
    return graph;
}

}  // namespace

WeightedGraph weighted_faces(const FaceGraph& graph, std::span<const double> cost) {
    assert(cost.size() == graph.edges.size());
    std::vector<Undirected> pairs;
    pairs.reserve(graph.edges.size());
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        pairs.push_back({graph.edges[e].face[0], graph.edges[e].face[1], cost[e]});
    }
    return graph_of(graph.size(), pairs);
}

WeightedGraph weighted_points(const FaceGraph& graph) {
    std::vector<Undirected> pairs;
    pairs.reserve(graph.edges.size());
    for (const DualEdge& edge : graph.edges) pairs.push_back({edge.point[0], edge.point[1], edge.length});
    return graph_of(graph.mesh->points.size(), pairs);
}

ShortestPaths shortest_paths(const WeightedGraph& graph, std::span<const std::uint32_t> sources,
                             std::span<const std::uint32_t> group) {
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, source, element
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    ShortestPaths paths;
    paths.cost.assign(graph.size(), std::numeric_limits<double>::infinity());
    paths.source.assign(graph.size(), no_source);
    std::vector<bool> is_done(graph.size(), false);
    const auto offer = [&](double cost, std::uint32_t source, std::uint32_t element) {
        if (is_done[element] || cost > paths.cost[element]) return;
        if (cost == paths.cost[element] && source >= paths.source[element]) return;
        paths.cost[element] = cost;
        paths.source[element] = source;
        queue.emplace(cost, source, element);
    };
    for (std::uint32_t s = 0; s < sources.size(); ++s) offer(0, s, sources[s]);
    while (!queue.empty()) {
        const auto [cost, source, element] = queue.top();
        queue.pop();
        if (is_done[element]) continue;
        is_done[element] = true;
        paths.order.push_back(element);
        for (const Arc& arc : graph[element]) {
            if (group.empty() || group[arc.to] == group[element]) offer(cost + arc.cost, source, arc.to);
        }
    }
    return paths;
}

}  // namespace qchopper
