#include "segment/joint/axis_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

Vec3 random_point(std::mt19937& random) {
    std::uniform_real_distribution<double> in(-10, 10);
    const double x = in(random);
    const double y = in(random);
    return {x, y, in(random)};
}

double sampled(const Axis& axis, const std::array<Vec3, 3>& triangle) {
    double least = 1e9;
    for (int i = 0; i <= 2000; ++i) {
        const Vec3 p = axis.begin + i / 2000.0 * (axis.end - axis.begin);
        least = std::min(least, norm(p - closest_on_triangle(p, triangle)));
    }
    return least;
}

TEST(AxisDistance, EqualsTheLeastOfManySamples) {
    std::mt19937 random(1);
    int crossing = 0;
    for (int i = 0; i < 2000; ++i) {
        const Axis axis{random_point(random), random_point(random)};
        const std::array<Vec3, 3> triangle{random_point(random), random_point(random), random_point(random)};
        const double found = distance_between(axis, triangle);
        const double step = norm(axis.end - axis.begin) / 4000;
        EXPECT_LE(found, sampled(axis, triangle) + 1e-9);
        EXPECT_GE(found, sampled(axis, triangle) - step - 1e-9);
        crossing += found == 0 ? 1 : 0;
    }
    EXPECT_GT(crossing, 50);
}

TEST(AxisDistance, BetweenSegmentsAlsoWhereTheyAreParallelOrPoints) {
    EXPECT_DOUBLE_EQ(distance_between(Axis{{0, 0, 0}, {0, 0, 5}}, Axis{{3, 0, 1}, {3, 0, 9}}), 3);
    EXPECT_DOUBLE_EQ(distance_between(Axis{{0, 0, 0}, {0, 0, 5}}, Axis{{3, 0, 9}, {3, 0, 10}}), 5);
    EXPECT_DOUBLE_EQ(distance_between(Axis{{0, 0, 0}, {0, 0, 0}}, Axis{{3, 4, 0}, {3, 4, 0}}), 5);
    EXPECT_DOUBLE_EQ(distance_between(Axis{{-1, 0, 0}, {1, 0, 0}}, Axis{{0, -1, 2}, {0, 1, 2}}), 2);
}

}  // namespace
}  // namespace qchopper
