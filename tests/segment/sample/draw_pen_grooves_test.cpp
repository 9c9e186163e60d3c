#include "segment/sample/draw_pen_grooves.h"

#include <gtest/gtest.h>

#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(DrawPenGrooves, MovesPointsInwardsUpToTheDepthAndLeavesTheRest) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 200, 120);
    TriangleMesh grooved = ball;
    DrawOptions options;
    options.pen_grooves = 3;
    options.width = 20;
    options.depth = 1;
    const DrawnPenGrooves drawn = draw_pen_grooves(grooved, options);
    EXPECT_EQ(drawn.lines.size(), 3U);
    EXPECT_EQ(grooved.triangles, ball.triangles);
    std::size_t moved = 0;
    double deepest = 0;
    for (std::size_t i = 0; i < ball.points.size(); ++i) {
        const double depth = norm(ball.points[i]) - norm(grooved.points[i]);
        EXPECT_GE(depth, 0);
        deepest = std::max(deepest, depth);
        moved += grooved.points[i] == ball.points[i] ? 0 : 1;
    }
    EXPECT_EQ(moved, drawn.points_moved);
    EXPECT_LE(deepest, 1 + 1e-9);
    EXPECT_GT(deepest, 0.8);
    EXPECT_GT(moved, 100U);
    EXPECT_LT(moved, ball.points.size() / 10);
}

TEST(DrawPenGrooves, OnASampleChangesNoTriangleAndIsTheSameEveryTime) {
    SampleOptions options;
    options.faces = 120000;
    const TriangleMesh plain = sample(Specimen::femur, options);
    options.pen_grooves = 2;
    DrawnPenGrooves drawn;
    const TriangleMesh grooved = sample(Specimen::femur, options, {}, &drawn);
    EXPECT_EQ(grooved.triangles, plain.triangles);
    EXPECT_GT(drawn.points_moved, 0U);
    EXPECT_NE(grooved.points, plain.points);
    EXPECT_EQ(sample(Specimen::femur, options), grooved);
}

}  // namespace
}  // namespace qchopper
