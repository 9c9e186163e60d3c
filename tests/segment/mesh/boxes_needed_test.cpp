#include "segment/mesh/boxes_needed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace qchopper {
namespace {

TEST(BoxesNeeded, ABoxThatFitsInSomeOrderIsOne) {
    EXPECT_EQ(boxes_needed({30, 10, 20}, {10, 20, 30}), 1);
    EXPECT_EQ(boxes_needed({0, 0, 0}, {10, 20, 30}), 1);
    EXPECT_EQ(boxes_needed({10, 20, 30 + 1e-7}, {10, 20, 30}), 1);
    EXPECT_EQ(boxes_needed({10, 20, 30.001}, {10, 20, 30}), 2);
}

TEST(BoxesNeeded, TheBestOrderOfTheAxesCounts) {
    EXPECT_EQ(boxes_needed({60, 10, 10}, {10, 20, 30}), 2);
    EXPECT_EQ(boxes_needed({60, 15, 15}, {10, 20, 30}), 4);
    EXPECT_EQ(boxes_needed({60, 60, 60}, {10, 20, 30}), 36);
}

TEST(BoxesNeeded, NothingIsEnoughForALimitWithoutVolume) {
    EXPECT_TRUE(std::isinf(boxes_needed({1, 1, 1}, {10, 0, 30})));
    EXPECT_TRUE(std::isinf(boxes_needed({1, 1, 1}, {10, -5, 30})));
}

TEST(BoxesNeeded, ALargerBoxNeverNeedsFewer) {
    const Vec3 limit{37, 23, 11};
    for (double x = 5; x < 120; x += 7) {
        for (double y = 5; y < 120; y += 11) {
            EXPECT_LE(boxes_needed({x, y, 40}, limit), boxes_needed({x + 3, y, 40}, limit));
        }
    }
}

}  // namespace
}  // namespace qchopper
