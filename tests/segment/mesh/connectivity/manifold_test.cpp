#include "segment/mesh/connectivity/manifold.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/repair/weld.h"
#include "tests/reference/segment/mesh/non_manifold_vertices.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Two boxes that touch in one corner only.
TriangleMesh touching_boxes() {
    TriangleMesh both = shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 1}, {2, 2, 2})});
    weld(both);
    return both;
}

TEST(Manifold, ClosedShapesHaveNoNonManifoldPoint) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(count_non_manifold_vertices(mesh, edges(mesh)), 0U) << shape.name;
        EXPECT_EQ(split_non_manifold_vertices(mesh, edges(mesh)), 0U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Manifold, SplitsAPointWhereTwoSurfacesTouch) {
    TriangleMesh both = touching_boxes();
    EXPECT_EQ(both.points.size(), 15U);
    EXPECT_EQ(count_non_manifold_vertices(both, edges(both)), 1U);
    EXPECT_EQ(split_non_manifold_vertices(both, edges(both)), 1U);
    EXPECT_EQ(both.points.size(), 16U);
    EXPECT_EQ(both.points.back(), (Vec3{1, 1, 1}));
    EXPECT_TRUE(edges(both).faults.is_closed());
    EXPECT_EQ(count_non_manifold_vertices(both, edges(both)), 0U);
}

// The two holes become one: its border passes the point twice, once for each copy.
TEST(Manifold, JoinsHolesThatTouchInAPoint) {
    // two squares that share a corner are removed from a side of a box
    TriangleMesh box = shapes::box({0, 0, 0}, {4, 4, 4}, 4);
    std::erase_if(box.triangles, [&](const Triangle& t) {
        const Vec3 middle = (1.0 / 3) * (box.points[t[0]] + box.points[t[1]] + box.points[t[2]]);
        const bool first = middle.x > 1 && middle.x < 2 && middle.y > 1 && middle.y < 2;
        const bool second = middle.x > 2 && middle.x < 3 && middle.y > 2 && middle.y < 3;
        return middle.z == 4 && (first || second);
    });
    EXPECT_EQ(split_non_manifold_vertices(box, edges(box)), 1U);
    const Edges found = edges(box);
    const IndexLists loops = border_loops(box, unpaired(box, found).open);
    ASSERT_EQ(loops.size(), 1U);
    EXPECT_EQ(loops[0].size(), 8U);
}

TEST(Manifold, BorderLoopsRunAroundTheHole) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 20);
    std::erase_if(ball.triangles, [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ball.points[v].z > 5; });
    });
    const Edges found = edges(ball);
    const Unpaired open = unpaired(ball, found);
    EXPECT_EQ(open.open.size(), found.faults.open);
    EXPECT_TRUE(open.non_manifold.empty());
    const IndexLists loops = border_loops(ball, open.open);
    ASSERT_EQ(loops.size(), 1U);
    EXPECT_EQ(loops[0].size(), found.faults.open);
    for (std::size_t i = 0; i < loops[0].size(); ++i) {
        EXPECT_EQ(start_of(ball, loops[0][i]), end_of(ball, loops[0][(i + 1) % loops[0].size()]));
    }
    EXPECT_NEAR(centre_of(ball, loops[0]).x, 0, 1e-9);
    EXPECT_GT(centre_of(ball, loops[0]).z, 4);
}

TEST(Manifold, DistinguishesNonManifoldEdgesFromOpenOnes) {
    TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    std::swap(box.triangles[0][0], box.triangles[0][1]);
    const Unpaired turned = unpaired(box, edges(box));
    EXPECT_EQ(turned.non_manifold.size(), 6U);  // both half-edges of three edges
    EXPECT_TRUE(turned.open.empty());
    box.triangles.push_back(box.triangles[5]);
    EXPECT_GT(unpaired(box, edges(box)).non_manifold.size(), 6U);
}

}  // namespace
}  // namespace qchopper
