#include "segment/regions/straight_borders.h"

#include <gtest/gtest.h>

#include "segment/regions/borders.h"
#include "segment/regions/labelling.h"
#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double border_length(const FaceGraph& graph, const Labels& labels) {
    double length = 0;
    for (const DualEdge& edge : graph.edges) {
        if (labels.of[edge.face[0]] != labels.of[edge.face[1]]) length += edge.length;
    }
    return length;
}

// A square of 20 x 20, each cell of two triangles.
TriangleMesh square() {
    constexpr std::uint32_t n = 20;
    TriangleMesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) mesh.points.push_back({1.0 * x, 1.0 * y, 0});
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return mesh;
}

TEST(StraightBorders, OfASquareAreItsMiddleLine) {
    const TriangleMesh mesh = square();
    const FaceGraph graph = face_graph(mesh);
    std::vector<std::uint32_t> of;
    for (const Vec3& c : graph.centroid) {
        const bool is_tooth = static_cast<int>(c.y) % 4 == 1 || static_cast<int>(c.y) % 4 == 2;
        of.push_back(c.x < (is_tooth ? 13 : 10) ? 0 : 1);
    }
    const Labels zigzag = numbered(of);
    EXPECT_GT(border_length(graph, zigzag), 40);
    const Labels straight = with_straight_borders(graph, zigzag);
    EXPECT_EQ(straight.count, 2U);
    EXPECT_NEAR(border_length(graph, straight), 20, 1e-9);
    EXPECT_EQ(with_straight_borders(graph, straight), straight);
}

TEST(StraightBorders, ThatAreClosedOrSharpStay) {
    const region_shapes::Shape boxes = region_shapes::two_boxes();
    const FaceGraph graph = face_graph(boxes.mesh);
    const Labels sides = numbered(region_shapes::flat_sides(graph));
    EXPECT_EQ(with_straight_borders(graph, sides), sides);
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5, 20);
    const FaceGraph round = face_graph(ball);
    std::vector<std::uint32_t> halves;
    for (const Vec3& c : round.centroid) halves.push_back(c.z > 0.3 * c.x ? 1 : 0);
    EXPECT_EQ(with_straight_borders(round, numbered(halves)), numbered(halves));
}

// The lower half lies flat, the upper half stands up. The border zigzags in both, and follows the fold between them.
TEST(StraightBorders, BetweenSharpEdgesAreStraightenedPartByPart) {
    TriangleMesh mesh = square();
    for (Vec3& p : mesh.points) {
        if (p.y > 10) p = {p.x, 10, p.y - 10};
    }
    const FaceGraph graph = face_graph(mesh);
    std::vector<std::uint32_t> of;
    for (const Vec3& c : graph.centroid) {
        const double y = c.y < 10 ? c.y : 10 + c.z;
        const bool is_tooth = static_cast<int>(y) % 4 == 1 || static_cast<int>(y) % 4 == 2;
        of.push_back(c.x < (y < 10 ? 5 : 15) - (is_tooth ? 2 : 0) ? 0 : 1);
    }
    const Labels zigzag = numbered(of);
    EXPECT_GT(border_length(graph, zigzag), 40);
    const Labels straight = with_straight_borders(graph, zigzag);
    const auto fold = [&](const Labels& labels) {
        double length = 0;
        for (const DualEdge& edge : graph.edges) {
            const bool is_border = labels.of[edge.face[0]] != labels.of[edge.face[1]];
            if (is_border && edge.turn >= max_chart_turn) length += edge.length;
        }
        return length;
    };
    ASSERT_GT(fold(zigzag), 9);
    EXPECT_NEAR(fold(straight), fold(zigzag), 1e-9);
    // Along edges each half is at most ten cells long and two wide.
    EXPECT_LT(border_length(graph, straight), 2 * (10 + 2) + fold(zigzag) + 1e-9);
    EXPECT_EQ(straight.count, 2U);
}

TEST(StraightBorders, AreNotLongerAndDivideTheSameRegions) {
    const region_shapes::Shape hand = region_shapes::hand();
    const FaceGraph graph = face_graph(hand.mesh);
    const Labels charts = sander_charts(graph, {});
    ASSERT_GT(charts.count, 3U);
    const Labels straight = with_straight_borders(graph, charts);
    EXPECT_EQ(straight.count, charts.count);
    EXPECT_LT(border_length(graph, straight), border_length(graph, charts));
    EXPECT_EQ(connected(graph, straight).count, straight.count);
}

}  // namespace
}  // namespace qchopper
