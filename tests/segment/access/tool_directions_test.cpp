#include "segment/access/tool_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/pieces.h"

namespace qchopper {
namespace {

double degrees(Vec3 a, Vec3 b) {
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 180 / std::numbers::pi;
}

double to_nearest(std::span<const Vec3> directions, Vec3 d, double not_below = -1) {
    double nearest = 180;
    for (const Vec3& other : directions) {
        const double angle = degrees(other, d);
        if (angle > not_below) nearest = std::min(nearest, angle);
    }
    return nearest;
}

constexpr std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const std::array<Vec3, 3> turned{normalized({3, 1, 0.2}), normalized({-1, 3, 0}), normalized({0.1, 0.2, 5})};

TEST(ToolDirections, AreThe258VerticesOfTheOctahedronAndTheAxes) {
    EXPECT_EQ(octahedron_normals().size(), 129U);
    EXPECT_EQ(tool_directions(world).size(), 258U);
    const std::vector<Vec3> directions = tool_directions(turned);
    ASSERT_EQ(directions.size(), 264U);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        EXPECT_NEAR(norm(directions[i]), 1, 1e-15);
        EXPECT_EQ(directions[i ^ 1U], -directions[i]);
        EXPECT_EQ(index_of(directions, directions[i]), i);
    }
    EXPECT_EQ(index_of(directions, normalized({1, 2, 3.001})), 264U);
}

TEST(ToolDirections, NeighboursLie11To16DegreesApartAndNothingIsFartherThan10) {
    const std::vector<Vec3> directions = tool_directions(world);
    for (const Vec3& d : directions) {
        const double neighbour = to_nearest(directions, d, 1e-3);
        EXPECT_GT(neighbour, 11.2);
        EXPECT_LT(neighbour, 15.5);
    }
    std::mt19937 random(3);
    double farthest = 0;
    for (int i = 0; i < 5'000; ++i) farthest = std::max(farthest, to_nearest(directions, random_normal(random)));
    EXPECT_LT(farthest, 10.0);
    EXPECT_GT(farthest, 9);
}

TEST(ToolDirections, TheOctahedronsAreClosedUnderReflectionInTheAxes) {
    const std::vector<Vec3> directions = tool_directions(world);
    for (const Vec3& d : directions) {
        for (const Vec3& image : {Vec3{-d.x, d.y, d.z}, Vec3{d.x, -d.y, d.z}, Vec3{d.x, d.y, -d.z}}) {
            EXPECT_LT(index_of(directions, image), directions.size());
        }
    }
}

TEST(ToolDirections, DenseOnesLeaveNoGap) {
    const std::vector<Vec3> dense = dense_directions();
    ASSERT_EQ(dense.size(), 2'000U);
    std::mt19937 random(4);
    for (int i = 0; i < 1'000; ++i) EXPECT_LT(to_nearest(dense, (i % 2 - 0.5) * 2 * random_normal(random)), 4);
}

TEST(ToolDirections, AllowedAreThoseWithinTheTilt) {
    const std::vector<Vec3> directions = tool_directions(world);
    const auto count = [&](double tilt) { return allowed_directions(directions, {0, 0, 1}, tilt).size(); };
    EXPECT_EQ(count(0), 1U);
    EXPECT_EQ(count(90), 129U + 16);  // 32 lie on the equator
    std::size_t before = 0;
    for (double tilt = 0; tilt <= 90; tilt += 5) {
        const std::vector<std::uint32_t> allowed = allowed_directions(directions, {0, 0, 1}, tilt);
        EXPECT_GE(allowed.size(), before);
        before = allowed.size();
        for (const std::uint32_t k : allowed) EXPECT_LE(degrees(directions[k], {0, 0, 1}), tilt + 3e-3);
    }
    EXPECT_TRUE(allowed_directions(directions, normalized({1, 2, 3.001}), 0).empty());
}

}  // namespace
}  // namespace qchopper
