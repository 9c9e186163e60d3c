#include "segment/mesh/plane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace qchopper {
namespace {

TEST(Plane, TheFirstComponentOfACanonicalNormalThatIsNotZeroIsPositive) {
    EXPECT_EQ(canonical({{-1, 0, 0}, 5}), (Plane{{1, 0, 0}, -5}));
    EXPECT_EQ(canonical({{0, -1, 0}, 5}), (Plane{{0, 1, 0}, -5}));
    EXPECT_EQ(canonical({{0, 0, -1}, -5}), (Plane{{0, 0, 1}, 5}));
    EXPECT_EQ(canonical({{0.6, -0.8, 0}, 5}), (Plane{{0.6, -0.8, 0}, 5}));
    EXPECT_EQ(canonical({{-0.6, 0.8, 0}, 5}), (Plane{{0.6, -0.8, 0}, -5}));
}

TEST(Plane, ACanonicalNormalHasLengthOneAndOnePlaneHasOneSetOfBits) {
    const Plane plane = canonical({{3, -4, 12}, 26});
    EXPECT_NEAR(norm(plane.normal), 1, 1e-15);
    EXPECT_NEAR(plane.offset, 2, 1e-15);
    EXPECT_EQ(canonical(plane), plane);
    EXPECT_EQ(canonical({-plane.normal, -plane.offset}), plane);
    const Plane without = canonical({{-0.0, -1, -0.0}, 0.0});
    EXPECT_FALSE(std::signbit(without.normal.x) || std::signbit(without.normal.z) || std::signbit(without.offset));
}

}  // namespace
}  // namespace qchopper
