#include "segment/repair/orient_outward.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Outward, SolidsStayAndWhatIsInsideOutIsTurned) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(orient_outward(mesh).turned, 0U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
        mesh = shapes::turned_inside_out(shape.mesh);
        const Outward counts = orient_outward(mesh);
        EXPECT_EQ(counts.turned, counts.shells) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Outward, OnlyCountsWhenAskedTo) {
    const TriangleMesh ball = shapes::turned_inside_out(shapes::ball({0, 0, 0}, 5));
    TriangleMesh mesh = ball;
    const Outward counts = orient_outward(mesh, false);
    EXPECT_EQ(counts.turned, 0U);
    EXPECT_EQ(counts.overlapping, 1U);
    EXPECT_EQ(mesh, ball);
}

TEST(Outward, CountsCavitiesAndOverlaps) {
    TriangleMesh nested = shapes::nested();
    EXPECT_EQ(orient_outward(nested).cavities, 2U);
    TriangleMesh inside = shapes::joined({shapes::box({0, 0, 0}, {90, 90, 90}), shapes::ball({40, 40, 40}, 20)});
    EXPECT_EQ(orient_outward(inside).overlapping, 1U);
}

TEST(Outward, ShellsThatTouchTurnTogetherOrNotAtAll) {
    const TriangleMesh large = shapes::box({0, 0, 0}, {9, 9, 9});
    const TriangleMesh fold = shapes::turned_inside_out(shapes::box({9, 9, 9}, {11, 11, 11}));
    const TriangleMesh apart = shapes::turned_inside_out(shapes::box({20, 0, 0}, {22, 2, 2}));
    const TriangleMesh hung = shapes::joined({large, fold});
    TriangleMesh mesh = hung;
    const Outward counts = orient_touching_outward(mesh);
    EXPECT_EQ(counts.turned + counts.overlapping, 0U);
    EXPECT_EQ(counts.left, 1U);
    EXPECT_EQ(mesh, hung);
    mesh = shapes::joined({hung, apart});
    EXPECT_EQ(orient_touching_outward(mesh).turned, 1U) << "a shell that touches nothing is turned as ever";
    EXPECT_EQ(mesh, shapes::joined({hung, shapes::turned_inside_out(apart)}));
    mesh = shapes::turned_inside_out(hung);
    EXPECT_EQ(orient_touching_outward(mesh).turned, 2U);
    EXPECT_EQ(mesh, hung);
}

TEST(Outward, ShellsThatTouchTurnByThemselvesWhereTheirVolumesCancel) {
    const TriangleMesh right = shapes::box({0, 0, 0}, {9, 9, 9});
    const TriangleMesh other = shapes::box({9, 9, 9}, {18, 18, 18});
    TriangleMesh mesh = shapes::joined({right, shapes::turned_inside_out(other)});
    EXPECT_EQ(orient_touching_outward(mesh).turned, 1U);
    EXPECT_EQ(mesh, shapes::joined({right, other}));
}

TEST(Outward, WhatTouchesNothingTurnsTheSameEitherWay) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (const bool is_turned : {false, true}) {
            TriangleMesh one = is_turned ? shapes::turned_inside_out(shape.mesh) : shape.mesh;
            TriangleMesh other = one;
            EXPECT_EQ(orient_outward(one).turned, orient_touching_outward(other).turned) << shape.name;
            EXPECT_EQ(one, other) << shape.name;
        }
    }
}

}  // namespace
}  // namespace qchopper
