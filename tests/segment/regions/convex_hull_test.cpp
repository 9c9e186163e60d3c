#include "segment/regions/engines/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(ConvexHull, OfABoxAndPointsInsideIsTheBox) {
    std::vector<Vec3> points = shapes::box({0, 0, 0}, {3, 4, 5}, 4).points;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 100; ++i) points.push_back({3 * share(random), 4 * share(random), 5 * share(random)});
    points.push_back(points.front());
    const ConvexHull hull = convex_hull_of(points);
    EXPECT_NEAR(hull.volume, 60, 1e-9);
    EXPECT_NEAR(hull.area, 94, 1e-9);
    for (const Plane& side : hull.sides) {
        EXPECT_NEAR(norm(side.normal), 1, 1e-12);
        for (const Vec3& p : points) EXPECT_LE(dot(side.normal, p), side.offset + 1e-12);
    }
}

TEST(ConvexHull, OfABallHasItsVolume) {
    const TriangleMesh ball = shapes::ball({1, 2, 3}, 5);
    const ConvexHull hull = convex_hull_of(ball.points);
    EXPECT_NEAR(hull.volume, volume_mm3(ball), 1e-3 * hull.volume);
    EXPECT_EQ(hull.points.size(), ball.points.size());
}

TEST(ConvexHull, OfPointsInAPlaneHasNoVolume) {
    std::vector<Vec3> points;
    for (int i = 0; i < 25; ++i) {
        const double x = i % 5;
        const int row = i / 5;
        const double y = row;
        points.push_back({x, y, 0.3 * x - 0.7 * y});
    }
    for (const std::size_t count : {0, 1, 2, 3, 25}) {
        const ConvexHull hull = convex_hull_of({points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count)});
        EXPECT_TRUE(hull.sides.empty()) << count;
        EXPECT_EQ(hull.volume, 0) << count;
    }
}

// What made the lists of points and triangles of CGAL 5.5 crash: corners of triangles, each several times.
TEST(ConvexHull, OfNearlyFlatPatchesIsFound) {
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 1e-13);
    for (int round = 0; round < 200; ++round) {
        std::vector<Vec3> points;
        for (int i = 0; i < 60; ++i) {
            const int column = i % 6;
            const int row = i / 6 % 5;
            points.push_back({1.0 * column, 1.0 * row, noise(random)});
        }
        for (int i = 0; i < round % 7; ++i) points.push_back({2.0, 2.0, 1.0 + i});
        const ConvexHull hull = convex_hull_of(points);
        EXPECT_EQ(hull.sides.empty(), round % 7 == 0) << round;
    }
}

}  // namespace
}  // namespace qchopper
