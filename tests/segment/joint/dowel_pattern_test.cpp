#include "segment/joint/dowel_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/segment/joint/turned_pattern.h"

namespace qchopper {
namespace {

constexpr double tolerance = 1.6;

TEST(DowelPattern, TwoEqualDowelsTurnAndTwoUnequalDoNot) {
    EXPECT_TRUE(can_be_turned({{0, {0, 0}}, {0, {40, 0}}}, tolerance));
    EXPECT_FALSE(can_be_turned({{0, {0, 0}}, {1, {40, 0}}}, tolerance));
    EXPECT_TRUE(can_be_turned({{0, {0, 0}}}, tolerance));
}

TEST(DowelPattern, ThreeEqualDowelsTurnUnlessTheirDistancesDiffer) {
    EXPECT_TRUE(can_be_turned({{0, {0, 0}}, {0, {40, 0}}, {0, {20, 30}}}, tolerance));
    EXPECT_FALSE(can_be_turned({{0, {0, 0}}, {0, {60, 0}}, {0, {20, 30}}}, tolerance));
}

TEST(DowelPattern, AMirroredPatternIsAlike) {
    const DowelPattern a{{0, {0, 0}}, {0, {60, 0}}, {1, {20, 30}}};
    const DowelPattern b{{0, {5, 5}}, {1, {25, -25}}, {0, {65, 5}}};
    EXPECT_TRUE(are_alike(a, b, tolerance));
    EXPECT_FALSE(are_alike(a, {{0, {5, 5}}, {1, {25, -29}}, {0, {69, 5}}}, tolerance));
}

// What is told apart is apart under every rotation, mirrored or not: the largest error of a dowel exceeds the
// tolerance.
TEST(DowelPattern, WhatIsNotAlikeFitsInNoRotation) {
    const DowelPattern a{{0, {0, 0}}, {1, {60, 0}}};
    for (double length = 40; length < 80; length += 0.25) {
        const DowelPattern b{{0, {3, 0}}, {1, {3, length}}};
        const double error = min_error_of_rotations(a, b);
        EXPECT_NEAR(error, std::abs(length - 60) / 2, 0.05);
        if (!are_alike(a, b, tolerance)) {
            EXPECT_GT(error, tolerance - 0.05);
        }
    }
}

TEST(DowelPattern, TheProposalsAreBoundedFarApartAndCannotBeTurned) {
    const std::vector<DowelSize> sizes = default_dowels();
    std::vector<Point2> grid;
    for (int x = 0; x < 40; ++x) {
        for (int y = 0; y < 30; ++y) grid.push_back({3.0 * x, 3.0 * y});
    }
    std::size_t proposed = 0;
    double first = 0;
    std::size_t dowels = 0;
    first_pattern(sizes, {grid, grid, grid}, tolerance, [&](const DowelPattern& pattern) {
        const double apart = std::hypot(pattern[0].at.x - pattern[1].at.x, pattern[0].at.y - pattern[1].at.y);
        if (++proposed == 1) first = apart;
        dowels = pattern.size();
        EXPECT_FALSE(can_be_turned(pattern, tolerance));
        EXPECT_GE(apart, 3 * std::max(sizes[pattern[0].size].diameter, sizes[pattern[1].size].diameter) - 1e-9);
        EXPECT_FALSE(pattern.size() == 2 && pattern[0].size == pattern[1].size);
        return false;
    });
    EXPECT_GT(first, std::hypot(117, 87) - 2 * tolerance);
    EXPECT_GT(proposed, 100u);
    EXPECT_LT(proposed, 5000u);
    EXPECT_EQ(dowels, 3u);
}

}  // namespace
}  // namespace qchopper
