// Points that touch are moved apart by next to nothing, into the side that the material asks for.

#include "segment/cut/contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace qchopper {
namespace {

using Loops = std::vector<Loop>;

std::optional<std::vector<Point2>> moved(const std::vector<Point2>& points, const Loops& loops) {
    std::vector<const Loop*> given;
    for (const Loop& loop : loops) given.push_back(&loop);
    return without_contacts(points, given);
}

double largest_move(const std::vector<Point2>& before, const std::vector<Point2>& after) {
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        most = std::max(most, std::hypot(after[i].x - before[i].x, after[i].y - before[i].y));
    }
    return most;
}

TEST(Contact, NothingIsMovedWhereNothingTouches) {
    EXPECT_FALSE(moved({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{0, 1, 2, 3}}));
    EXPECT_FALSE(
        moved({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {4, 4}, {4, 6}, {6, 6}, {6, 4}}, {{0, 1, 2, 3}, {4, 5, 6, 7}}));
}

// Two squares of material with a common corner, as one loop that passes the corner twice.
TEST(Contact, TwoPartsOfTheMaterialMoveApart) {
    const std::vector<Point2> points{{0, 0}, {5, 0}, {5, 5}, {10, 5}, {10, 10}, {5, 10}, {5, 5}, {0, 5}};
    const Loops loops{{0, 1, 2, 3, 4, 5, 6, 7}};
    const auto after = moved(points, loops);
    ASSERT_TRUE(after);
    EXPECT_GT(std::hypot((*after)[2].x - (*after)[6].x, (*after)[2].y - (*after)[6].y), 0);
    EXPECT_LT(largest_move(points, *after), 1e-8);
    EXPECT_NEAR(signed_area(*after, loops[0]), 50, 1e-6);
}

// A hole whose corner lies on an edge of the outer loop.
TEST(Contact, AHoleMovesAwayFromTheOuterLoop) {
    const std::vector<Point2> points{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 0}, {4, 3}, {6, 3}};
    const Loops loops{{0, 1, 2, 3}, {4, 5, 6}};
    const auto after = moved(points, loops);
    ASSERT_TRUE(after);
    EXPECT_GT((*after)[4].y, 0) << "into the material";
    EXPECT_LT(largest_move(points, *after), 1e-8);
    EXPECT_LT(signed_area(*after, loops[1]), 0);
}

}  // namespace
}  // namespace qchopper
