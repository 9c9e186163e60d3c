#include "segment/mesh/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<Point2> cloud(std::mt19937& random, int count, bool on_grid) {
    std::uniform_real_distribution<double> u(-5, 5);
    std::vector<Point2> points;
    for (int i = 0; i < count; ++i) {
        Point2 p{u(random), 0.4 * u(random)};
        if (on_grid) p = {std::round(p.x), std::round(p.y)};
        points.push_back(p);
    }
    return points;
}

Rectangle around(const std::vector<Point2>& points, Point2 u) {
    const double most = 1e300;
    double low[2] = {most, most};
    double high[2] = {-most, -most};
    for (const Point2& p : points) {
        const double at[2] = {u.x * p.x + u.y * p.y, -u.y * p.x + u.x * p.y};
        for (int k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
        }
    }
    return {u, high[0] - low[0], high[1] - low[1]};
}

TEST(Footprint, HullHoldsAllPointsAndTurnsOneWay) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        const std::vector<Point2> points = cloud(random, 3 + round % 60, round % 2 == 0);
        const std::vector<Point2> hull = convex_hull(points);
        if (hull.size() < 3) continue;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Point2 a = hull[i];
            const Point2 b = hull[(i + 1) % hull.size()];
            for (const Point2& p : points) {
                EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), -1e-9);
            }
        }
    }
}

TEST(Footprint, NoTurnHasASmallerRectangle) {
    std::mt19937 random(2);
    for (int round = 0; round < 200; ++round) {
        const std::vector<Point2> points = cloud(random, 3 + round % 40, round % 2 == 0);
        const Rectangle best = smallest_rectangle(points);
        const Rectangle checked = around(points, best.along);
        EXPECT_NEAR(checked.length, best.length, 1e-9) << "the sizes are those of the rectangle along `along`";
        EXPECT_NEAR(checked.width, best.width, 1e-9);
        EXPECT_GE(best.length, best.width);
        for (int turn = 0; turn < 720; ++turn) {
            const double angle = turn * std::numbers::pi / 1440;
            EXPECT_GE(around(points, {std::cos(angle), std::sin(angle)}).area(), best.area() - 1e-9);
        }
    }
}

TEST(Footprint, ATurnedRectangleIsFoundExactly) {
    for (const double angle : {0.0, 0.1, 0.7, 1.5, 2.9}) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        std::vector<Point2> points;
        for (const Point2 p : std::vector<Point2>{{0, 0}, {7, 0}, {7, 2}, {0, 2}, {3, 1}}) {
            points.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
        }
        const Rectangle best = smallest_rectangle(points);
        EXPECT_NEAR(best.length, 7, 1e-12);
        EXPECT_NEAR(best.width, 2, 1e-12);
        EXPECT_NEAR(std::abs(best.along.x * c + best.along.y * s), 1, 1e-12);
    }
}

TEST(Footprint, PointsInLineAndASinglePointHaveNoWidth) {
    EXPECT_EQ(smallest_rectangle({}).area(), 0);
    EXPECT_EQ(smallest_rectangle({{3, 4}, {3, 4}}).length, 0);
    const Rectangle line = smallest_rectangle({{0, 0}, {3, 4}, {1.5, 2}, {0, 0}});
    EXPECT_DOUBLE_EQ(line.length, 5);
    EXPECT_EQ(line.width, 0);
    EXPECT_DOUBLE_EQ(line.along.x, 0.6);
}

TEST(Footprint, AHullOfManyPointsIsTurnedAroundOnce) {
    std::vector<Point2> circle;
    for (int i = 0; i < 200000; ++i) {
        const double angle = 2 * std::numbers::pi * i / 200000;
        circle.push_back({std::cos(angle), std::sin(angle)});
    }
    EXPECT_NEAR(smallest_rectangle(circle).area(), 4, 1e-6);
}

}  // namespace
}  // namespace qchopper
