#include "segment/sample/thin_out.h"

#include <gtest/gtest.h>

#include "segment/sample/crossing.h"
#include "tests/segment/sample/laws.h"
#include "tests/segment/sample/self_intersections.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(ThinOut, KeepsBallsAndRingsWhatTheyAre) {
    const TriangleMesh ball = shapes::ball({5, 6, 7}, 10, 40);
    TriangleMesh thin_ball = ball;
    thin_out(thin_ball, 300, {});
    EXPECT_EQ(thin_ball.triangles.size(), 300U);
    expect_valid_solid(thin_ball);
    EXPECT_EQ(genus(thin_ball), 0);
    EXPECT_NEAR(volume_mm3(thin_ball) / volume_mm3(ball), 1, 0.05);

    const TriangleMesh ring = shapes::torus({0, 0, 0}, 20, 6, 60);
    TriangleMesh thin_ring = ring;
    thin_out(thin_ring, 400, {});
    EXPECT_EQ(thin_ring.triangles.size(), 400U);
    expect_valid_solid(thin_ring);
    EXPECT_EQ(genus(thin_ring), 1);
    EXPECT_EQ(count_self_intersections(thin_ring), 0U);
}

// Two balls a hair apart must not grow into each other.
TEST(ThinOut, NeighboursNeverMeet) {
    TriangleMesh pair = shapes::joined({shapes::ball({0, 0, 0}, 10, 40), shapes::ball({0, 0, 20.02}, 10, 40)});
    thin_out(pair, 200, {});
    EXPECT_EQ(count_self_intersections(pair), 0U);
    EXPECT_EQ(shells(pair).count(), 2U);
}

TEST(ThinOut, PointsThatStayDoNotMove) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 30);
    TriangleMesh thin = ball;
    thin_out(thin, 200, {});
    for (const Vec3& p : thin.points)
        EXPECT_NE(std::find(ball.points.begin(), ball.points.end(), p), ball.points.end());
}

TEST(ThinOut, LeavesAMeshThatIsSmallEnough) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 8);
    TriangleMesh same = ball;
    thin_out(same, ball.triangles.size(), {});
    EXPECT_EQ(same, ball);
}

TEST(Crossing, TellsTrianglesThatCrossFromThoseThatOnlyShareACorner) {
    const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0},   {0, 4, 0}, {1, 1, -1},
                                   {1, 1, 1}, {5, 5, 0.5}, {0, 0, 5}, {-4, 0, 1}};
    EXPECT_TRUE(triangles_cross(points, {0, 1, 2}, {3, 4, 5}));
    EXPECT_FALSE(triangles_cross(points, {0, 1, 2}, {5, 6, 4}));
    EXPECT_FALSE(triangles_cross(points, {0, 1, 2}, {0, 6, 7}));
    EXPECT_TRUE(triangles_cross(points, {0, 1, 2}, {0, 3, 4}));
    EXPECT_FALSE(triangles_cross(points, {0, 1, 2}, {1, 0, 6}));
    EXPECT_TRUE(triangles_cross(points, {0, 1, 2}, {0, 2, 1}));
}

}  // namespace
}  // namespace qchopper
