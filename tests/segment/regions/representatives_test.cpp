#include "segment/regions/engines/representatives.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Representatives, AreFarFromEachOther) {
    const TriangleMesh bar = shapes::box({0, 0, 0}, {20, 1, 1}, 12);
    const FaceGraph graph = face_graph(bar);
    std::vector<double> cost;
    for (const DualEdge& edge : graph.edges) cost.push_back(edge.path);
    const WeightedGraph weighted = weighted_faces(graph, cost);
    const Representatives found = farthest_first(weighted, nearest_face(graph, {0, 0.5, 0.5}), 3);
    ASSERT_EQ(found.element.size(), 3U);
    EXPECT_GT(graph.centroid[found.element[1]].x, 16);
    EXPECT_NEAR(graph.centroid[found.element[2]].x, 10, 3);
    EXPECT_GT(found.gap[1], found.gap[2]);
}

TEST(Representatives, TheirNumberIsWhereTheGapFallsMost) {
    EXPECT_EQ(count_at_largest_fall({1e9, 10, 9, 8, 2, 1}), 4U);
    EXPECT_EQ(count_at_largest_fall({1e9, 10, 1, 0.5}), 2U);
    EXPECT_EQ(count_at_largest_fall({1e9}), 1U);
    EXPECT_EQ(count_at_largest_fall({}), 0U);
}

TEST(Representatives, TwoThatBeginAtOneEndDivideTheSurfaceInHalves) {
    const TriangleMesh bar = region_shapes::cylinder().mesh;
    const FaceGraph graph = face_graph(bar);
    std::vector<double> cost;
    for (const DualEdge& edge : graph.edges) cost.push_back(edge.path);
    const WeightedGraph weighted = weighted_faces(graph, cost);
    const std::vector<std::uint32_t> at_end{nearest_face(graph, {0, 0, 0}), nearest_face(graph, {8, 0, 2})};
    const Grouping groups = grouped(weighted, graph.area, graph.centroid, at_end, 30);
    std::array<double, 2> area{};
    for (std::size_t f = 0; f < graph.size(); ++f) area[groups.of[f]] += graph.area[f];
    EXPECT_NEAR(area[0], area[1], 0.1 * area[1]);
}

}  // namespace
}  // namespace qchopper
