#include "segment/sample/draw_marks.h"

#include <gtest/gtest.h>

#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(DrawMarks, PressPointsInwardsUpToTheDepthAndLeaveTheRest) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 200, 120);
    TriangleMesh drawn = ball;
    DrawOptions options;
    options.marks = 3;
    options.width = 20;
    options.depth = 1;
    const DrawnMarks marks = draw_marks(drawn, options);
    EXPECT_EQ(marks.lines.size(), 3U);
    EXPECT_EQ(drawn.triangles, ball.triangles);
    std::size_t moved = 0;
    double deepest = 0;
    for (std::size_t i = 0; i < ball.points.size(); ++i) {
        const double depth = norm(ball.points[i]) - norm(drawn.points[i]);
        EXPECT_GE(depth, 0);
        deepest = std::max(deepest, depth);
        moved += drawn.points[i] == ball.points[i] ? 0 : 1;
    }
    EXPECT_EQ(moved, marks.points_moved);
    EXPECT_LE(deepest, 1 + 1e-9);
    EXPECT_GT(deepest, 0.8);
    EXPECT_GT(moved, 100U);
    EXPECT_LT(moved, ball.points.size() / 10);
}

TEST(DrawMarks, OfASampleChangeNoTriangleAndAreTheSameEveryTime) {
    SampleOptions options;
    options.faces = 120000;
    const TriangleMesh plain = sample(Specimen::femur, options);
    options.marks = 2;
    DrawnMarks drawn;
    const TriangleMesh with_marks = sample(Specimen::femur, options, {}, &drawn);
    EXPECT_EQ(with_marks.triangles, plain.triangles);
    EXPECT_GT(drawn.points_moved, 0U);
    EXPECT_NE(with_marks.points, plain.points);
    EXPECT_EQ(sample(Specimen::femur, options), with_marks);
}

}  // namespace
}  // namespace qchopper
