#include "segment/mesh/measure.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Measure, ABoxHasTheVolumeAndAreaOfABox) {
    const TriangleMesh box = shapes::box({1, 2, 3}, {3, 5, 7}, 3);
    EXPECT_NEAR(volume_mm3(box), 24, 1e-12);
    EXPECT_NEAR(area_mm2(box), 2 * (6 + 8 + 12), 1e-12);
    EXPECT_EQ(bounds(box), (Box{{1, 2, 3}, {3, 5, 7}}));
}

TEST(Measure, TurnedInsideOutTheVolumeIsNegative) {
    const TriangleMesh ball = shapes::ball({3, 1, -4}, 10);
    EXPECT_DOUBLE_EQ(volume_mm3(shapes::turned_inside_out(ball)), -volume_mm3(ball));
}

TEST(Measure, MovingFarAwayChangesTheVolumeOnlyByRounding) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10);
    EXPECT_NEAR(volume_mm3(shapes::moved(ball, {1e6, -1e6, 1e6})) / volume_mm3(ball), 1, 1e-9);
}

}  // namespace
}  // namespace qchopper
