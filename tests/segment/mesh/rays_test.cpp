#include "segment/mesh/rays.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Rays, MeetTheFirstSurfaceFromEitherSide) {
    const RayTree tree(shapes::box({0, 0, 0}, {10, 10, 10}));
    EXPECT_NEAR(tree.first_hit({5, 5, -7}, {0, 0, 1})->distance, 7, 1e-5);
    EXPECT_NEAR(tree.first_hit({5, 4, 3}, {0, 0, 1})->distance, 7, 1e-5);
    EXPECT_FALSE(tree.first_hit({5, 5, -7}, {0, 0, -1}).has_value());
}

TEST(Rays, FarFromTheOriginAHundredthOfAMillimetreIsResolved) {
    const RayTree tree(shapes::moved(shapes::box({0, 0, 0}, {10, 10, 10}), {1e6, 1e6, 1e6}));
    EXPECT_NEAR(tree.first_hit({1e6 + 5, 1e6 + 4, 1e6 - 7.01}, {0, 0, 1})->distance, 7.01, 1e-5);
}

}  // namespace
}  // namespace qchopper
