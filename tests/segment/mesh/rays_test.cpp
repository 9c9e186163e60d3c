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

TEST(Rays, AnExitPassesOverSurfacesThatTheRayEnters) {
    const RayTree tree(shapes::box({0, 0, 0}, {10, 10, 10}));
    EXPECT_NEAR(tree.first_exit({5, 4, -7}, {0, 0, 1})->distance, 17, 1e-5);
    EXPECT_NEAR(tree.first_exit({5, 4, 0}, {0, 0, 1})->distance, 10, 1e-5);  // starts on the face it enters by
    EXPECT_FALSE(tree.first_exit({5, 4, 10.5}, {0, 0, 1}).has_value());
}

TEST(Rays, AnExitStopsAtTheNearSideOfACavity) {
    const RayTree tree(shapes::joined(
        {shapes::box({0, 0, 0}, {10, 10, 10}), shapes::turned_inside_out(shapes::box({3, 3, 3}, {7, 7, 7}))}));
    EXPECT_NEAR(tree.first_exit({5, 4, 0}, {0, 0, 1})->distance, 3, 1e-5);
}

TEST(Rays, ThreeMetresFromTheOriginAHundredthOfAMillimetreStillCounts) {
    const RayTree tree(shapes::moved(shapes::box({0, 0, 0}, {10, 10, 10}), {1e6, 1e6, 1e6}));
    EXPECT_NEAR(tree.first_hit({1e6 + 5, 1e6 + 4, 1e6 - 7.01}, {0, 0, 1})->distance, 7.01, 1e-5);
}

}  // namespace
}  // namespace qchopper
