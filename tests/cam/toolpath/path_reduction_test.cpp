// Reduced paths: between all gates, with as few corners as known lines need, and rounded only where that fits too.

#include "cam/toolpath/finishing/path_reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace qchopper {
namespace {

constexpr double width = 0.1;

// The graph of a function, gates upright.
template <class Function>
std::vector<Gate> graph(std::size_t count, double step, const Function& function) {
    std::vector<Gate> gates;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = step * static_cast<double>(i);
        const double y = function(x);
        gates.push_back({{x, y}, {x, y + width}});
    }
    return gates;
}

// The height of a path that goes on towards larger x.
double height_at(const std::vector<ReducedPoint>& path, double x) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Point2 a = path[i - 1].at;
        const Point2 b = path[i].at;
        if (x <= b.x) return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
    }
    return path.back().at.y;
}

TEST(PathReduction, PassesEveryGate) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 50; ++k) {
        double y = 0;
        double slope = 0;
        const std::vector<Gate> gates = graph(300, 0.25, [&](double) {
            slope = 0.9 * slope + 0.02 * k * unit(random);
            return y += slope;
        });
        const std::vector<ReducedPoint> path = reduced_path(gates, false, {});
        for (const Gate& gate : gates) {
            const double at = height_at(path, gate.right.x);
            ASSERT_GE(at, gate.right.y - 1e-9);
            ASSERT_LE(at, gate.left.y + 1e-9);
        }
        EXPECT_EQ(path.front().at.x, gates.front().right.x);
        EXPECT_EQ(path.back().at.x, gates.back().right.x);
    }
}

TEST(PathReduction, AnArcNeedsChordsOfTheTolerance) {
    // A chord may be sqrt(8 * radius * width) long, 4 mm; gates allow it to within one of their distances.
    const double radius = 20;
    for (const double sign : {1.0, -1.0}) {
        const std::vector<Gate> gates = graph(
            161, 0.25, [&](double x) { return sign * std::sqrt(100 * 100 - (x - 20) * (x - 20)) * radius / 100; });
        // The arc is flatter than a circle by the factor; its chord is sqrt(8 * 500 * 0.1) = 20 mm.
        EXPECT_LE(reduced_path(gates, false, {}).size(), 4U) << sign;
    }
    EXPECT_EQ(reduced_path(graph(100, 0.25, [](double x) { return 0.3 * x; }), false, {}).size(), 2U);
}

// A circle of exact radius r, run through so that its outside is on the left.
std::vector<Gate> circle(double r, std::size_t count) {
    std::vector<Gate> gates;
    for (std::size_t i = 0; i <= count; ++i) {
        const double angle = -6.283185307179586 * static_cast<double>(i % count) / static_cast<double>(count);
        const Point2 out{std::cos(angle), std::sin(angle)};
        gates.push_back({{r * out.x, r * out.y}, {(r + width) * out.x, (r + width) * out.y}});
    }
    return gates;
}

TEST(PathReduction, AClosedPathGoesRound) {
    const std::vector<ReducedPoint> path = reduced_path(circle(30, 700), true, {1});
    ASSERT_GE(path.size(), 4U);
    EXPECT_EQ(path.front().at, path.back().at);
    const double circumference = 6.2832 * 30;
    EXPECT_LE(static_cast<double>(path.size()), 1.25 * circumference / std::sqrt(8 * 30 * width) + 2);
    for (std::size_t i = 1; i < path.size(); ++i) {
        for (double t = 0; t <= 1; t += 0.05) {
            const Point2 a = path[i - 1].at;
            const Point2 b = path[i].at;
            const double r = std::hypot(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
            ASSERT_GE(r, 30 - 1e-3);
            ASSERT_LE(r, 30 + 1.5 * width + 1e-3) << "half a width more for rounded corners";
        }
    }
}

TEST(PathReduction, NoRoundedCornerLeavesTheGates) {
    for (const double rounding : {0.5, 2.0, 20.0}) {
        const std::vector<ReducedPoint> path = reduced_path(circle(30, 700), true, {rounding});
        std::size_t rounded = 0;
        for (std::size_t i = 1; i + 1 < path.size(); ++i) {
            if (!path[i].is_rounded) continue;
            ++rounded;
            const auto side = [&](std::size_t k) {
                return std::hypot(path[k].at.x - path[i].at.x, path[k].at.y - path[i].at.y);
            };
            const double a = std::min({rounding, 0.5 * side(i - 1), 0.5 * side(i + 1)});
            const auto towards = [&](std::size_t k) {
                const double t = a / side(k);
                return Point2{path[i].at.x + t * (path[k].at.x - path[i].at.x),
                              path[i].at.y + t * (path[k].at.y - path[i].at.y)};
            };
            const Point2 begin = towards(i - 1);
            const Point2 end = towards(i + 1);
            const Point2 middle{0.25 * (begin.x + end.x) + 0.5 * path[i].at.x,
                                0.25 * (begin.y + end.y) + 0.5 * path[i].at.y};
            EXPECT_GE(std::hypot(middle.x, middle.y), 30 - 0.02 * width - 1e-3);
        }
        EXPECT_GT(rounded, path.size() / 2) << rounding;
    }
    // A peak of 90 degrees: rounded by 1 mm it would be 0.35 mm lower. A valley: as much higher.
    for (const double sign : {1.0, -1.0}) {
        const auto peak = graph(81, 0.25, [&](double x) { return -sign * std::abs(x - 10); });
        for (const ReducedPoint& p : reduced_path(peak, false, {1})) EXPECT_FALSE(p.is_rounded);
        std::size_t rounded = 0;
        for (const ReducedPoint& p : reduced_path(peak, false, {0.1})) rounded += p.is_rounded ? 1 : 0;
        EXPECT_GT(rounded, 0U) << "by 0.1 mm it is 0.035 mm";
    }
    for (const ReducedPoint& p : reduced_path(circle(30, 700), true, {})) EXPECT_FALSE(p.is_rounded);
}

}  // namespace
}  // namespace qchopper
