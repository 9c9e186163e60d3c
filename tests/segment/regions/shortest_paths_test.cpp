#include "segment/regions/engines/shortest_paths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// The same by relaxing all arcs until nothing changes.
std::vector<double> relaxed(const WeightedGraph& graph, std::uint32_t source) {
    std::vector<double> cost(graph.size(), std::numeric_limits<double>::infinity());
    cost[source] = 0;
    for (bool changes = true; changes;) {
        changes = false;
        for (std::size_t e = 0; e < graph.size(); ++e) {
            for (const Arc& arc : graph[e]) {
                if (!(cost[e] + arc.cost < cost[arc.to])) continue;
                cost[arc.to] = cost[e] + arc.cost;
                changes = true;
            }
        }
    }
    return cost;
}

TEST(ShortestPaths, AreThoseOfRelaxation) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 10, 3, 12);
    const FaceGraph graph = face_graph(torus);
    std::vector<double> cost;
    for (const DualEdge& edge : graph.edges) cost.push_back(edge.path);
    for (const WeightedGraph& weighted : {weighted_faces(graph, cost), weighted_points(graph)}) {
        const std::vector<std::uint32_t> one{5};
        const ShortestPaths paths = shortest_paths(weighted, one);
        EXPECT_EQ(paths.cost, relaxed(weighted, 5));
        EXPECT_EQ(paths.order.size(), weighted.size());
        EXPECT_TRUE(std::ranges::is_sorted(paths.order, {}, [&](std::uint32_t e) { return paths.cost[e]; }));
        const std::vector<std::uint32_t> both{5, 40};
        const std::vector<double> other = relaxed(weighted, 40);
        const ShortestPaths nearest = shortest_paths(weighted, both);
        for (std::size_t e = 0; e < weighted.size(); ++e) {
            EXPECT_EQ(nearest.cost[e], std::min(paths.cost[e], other[e]));
            EXPECT_EQ(nearest.source[e], paths.cost[e] <= other[e] ? 0U : 1U);
        }
    }
}

TEST(ShortestPaths, StayInTheGroupOfTheirSource) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1}, 3);
    const FaceGraph graph = face_graph(box);
    const std::vector<double> cost(graph.edges.size(), 1);
    std::vector<std::uint32_t> group;
    for (const Vec3& n : graph.normal) group.push_back(n.z > 0.5 ? 1 : 0);
    const std::vector<std::uint32_t> source{nearest_face(graph, {0.5, 0.5, 1})};
    const ShortestPaths paths = shortest_paths(weighted_faces(graph, cost), source, group);
    for (std::size_t f = 0; f < graph.size(); ++f) EXPECT_EQ(paths.source[f], group[f] == 1 ? 0U : no_source);
}

}  // namespace
}  // namespace qchopper
