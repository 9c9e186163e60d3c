#include "segment/repair/outwards.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Outwards, SolidsStayAndWhatIsInsideOutIsTurned) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(turn_outwards(mesh).turned, 0U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
        mesh = shapes::turned_inside_out(shape.mesh);
        const Outwards counts = turn_outwards(mesh);
        EXPECT_EQ(counts.turned, counts.shells) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Outwards, OnlyCountsWhenToldSo) {
    const TriangleMesh ball = shapes::turned_inside_out(shapes::ball({0, 0, 0}, 5));
    TriangleMesh mesh = ball;
    const Outwards counts = turn_outwards(mesh, false);
    EXPECT_EQ(counts.turned, 0U);
    EXPECT_EQ(counts.overlapping, 1U);
    EXPECT_EQ(mesh, ball);
}

TEST(Outwards, CountsCavitiesAndOverlaps) {
    TriangleMesh nested = shapes::nested();
    EXPECT_EQ(turn_outwards(nested).cavities, 2U);
    TriangleMesh inside = shapes::joined({shapes::box({0, 0, 0}, {90, 90, 90}), shapes::ball({40, 40, 40}, 20)});
    EXPECT_EQ(turn_outwards(inside).overlapping, 1U);
}

}  // namespace
}  // namespace qchopper
