#include "segment/regions/face_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(FaceGraph, ACubeHasTwelveTrianglesAndEighteenDualEdges) {
    const TriangleMesh cube = shapes::box({0, 0, 0}, {2, 2, 2});
    const FaceGraph graph = face_graph(cube);
    ASSERT_EQ(graph.size(), 12U);
    EXPECT_EQ(graph.edges.size(), 18U);
    EXPECT_DOUBLE_EQ(graph.diagonal, std::sqrt(12.0));
    std::size_t flat = 0;
    for (const DualEdge& edge : graph.edges) {
        EXPECT_LT(edge.face[0], edge.face[1]);
        EXPECT_FALSE(edge.is_concave);
        flat += edge.turn < 1e-9 ? 1 : 0;
        if (edge.turn >= 1e-9) {
            EXPECT_NEAR(edge.turn, std::numbers::pi / 2, 1e-9);
            EXPECT_NEAR(edge.length, 2, 1e-12);
        }
    }
    EXPECT_EQ(flat, 6U);  // the diagonals
}

TEST(FaceGraph, EveryTriangleOfAClosedMeshHasThreeNeighbours) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 10, 3);
    const FaceGraph graph = face_graph(torus);
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
        for (const std::uint32_t e : graph.around[f]) {
            ASSERT_NE(e, no_dual_edge);
            EXPECT_NE(graph.across(e, f), f);
            EXPECT_EQ(graph.across(e, graph.across(e, f)), f);
        }
    }
}

TEST(FaceGraph, StairsHaveConcaveEdges) {
    const TriangleMesh stairs = shapes::stairs();
    double concave = 0;
    for (const DualEdge& edge : face_graph(stairs).edges) concave += edge.is_concave ? edge.length : 0;
    EXPECT_GT(concave, 0);
    const TriangleMesh inside_out = shapes::turned_inside_out(shapes::box({0, 0, 0}, {1, 1, 1}));
    for (const DualEdge& edge : face_graph(inside_out).edges) EXPECT_EQ(edge.is_concave, edge.turn > 1e-9);
}

TEST(FaceGraph, ASingleTriangleHasNoNeighbour) {
    const TriangleMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
    const FaceGraph graph = face_graph(one);
    EXPECT_TRUE(graph.edges.empty());
    EXPECT_DOUBLE_EQ(graph.area[0], 0.5);
    EXPECT_EQ(nearest_face(graph, {9, 9, 9}), 0U);
    EXPECT_EQ(farthest_face(graph, {9, 9, 9}), 0U);
}

}  // namespace
}  // namespace qchopper
