// Parts of passes that cut, against a plain loop over places and cells.

#include "cam/toolpath/cutting_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cam/toolpath/pass_stretches.h"
#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;

constexpr double film = 0.2;

HeightField stock_of(std::size_t columns, std::size_t rows, float height) {
    HeightField stock;
    stock.cell = 0.5;
    stock.columns = columns;
    stock.rows = rows;
    stock.height.assign(columns * rows, height);
    return stock;
}

// Foam 5 mm high from one x to another.
void stand(HeightField& stock, double from, double to) {
    for (std::size_t i = 0; i < stock.height.size(); ++i) {
        const double x = stock.cell * (static_cast<double>(i % stock.columns) + 0.5);
        if (x > from && x < to) stock.height[i] = 5;
    }
}

Pass line(Vec3 from, Vec3 to) {
    return {{{from}, {to}}, false};
}

// The most that a ball with its tip at a point takes off a cell's centre.
double depth(const HeightField& stock, Vec3 tip, double radius) {
    double most = 0;
    for (std::size_t i = 0; i < stock.height.size(); ++i) {
        const std::size_t row = i / stock.columns;
        const double x = stock.cell * (static_cast<double>(i % stock.columns) + 0.5) - tip.x;
        const double y = stock.cell * (static_cast<double>(row) + 0.5) - tip.y;
        const double below = radius * radius - x * x - y * y;
        if (below <= 0) continue;
        most = std::max(most, static_cast<double>(stock.height[i]) - (tip.z + radius - std::sqrt(below)));
    }
    return most;
}

double distance(Vec3 p, const Pass& pass) {
    double least = 1e9;
    for (std::size_t i = 1; i < pass.points.size(); ++i) {
        const Vec3 a = pass.points[i - 1].tip;
        const Vec3 along = pass.points[i].tip - a;
        const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
        least = std::min(least, norm(a + t * along - p));
    }
    return least;
}

TEST(CuttingParts, WhatIsLeftOutCutsNoMoreThanAFilmAndEveryPartCuts) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> at(3, 47);
    const CuttingTool tool = ball_tool(6);
    HeightField stock = stock_of(100, 100, 0);
    // A few columns of stock, so that most of the passes are air.
    for (int k = 0; k < 25; ++k) stock.height[random() % stock.height.size()] = 1.4F + 0.02F * static_cast<float>(k);
    std::vector<Pass> passes;
    for (int i = 0; i < 60; ++i) {
        passes.push_back({{}, i % 3 == 0});
        for (int k = 0; k < 4; ++k) passes.back().points.push_back({{at(random), at(random), 1.3}, true});
        if (passes.back().is_closed) passes.back().points.push_back(passes.back().points.front());
    }
    const std::vector<Pass> parts = cutting_parts(passes, stock, tool, film);
    std::size_t left_out = 0;
    for (const Pass& pass : passes) {
        for (std::size_t i = 1; i < pass.points.size(); ++i) {
            const Vec3 way = pass.points[i].tip - pass.points[i - 1].tip;
            for (double s = 0; s < 1; s += 0.7 / norm(way)) {
                const Vec3 p = pass.points[i - 1].tip + s * way;
                const bool is_made =
                    std::ranges::any_of(parts, [&](const Pass& part) { return distance(p, part) < 1e-6; });
                if (is_made) continue;
                ++left_out;
                // Between samples a quarter of a cell off the ball is lower by at most that times its slope.
                EXPECT_LE(depth(stock, p, 3), film + 0.1);
            }
        }
        EXPECT_EQ(is_cutting(pass, stock, tool, film), !cutting_parts({pass}, stock, tool, film).empty());
    }
    EXPECT_GT(left_out, 1500U) << "of about 8000 places";
    EXPECT_LT(length_of(parts), 0.8 * length_of(passes));
    for (const Pass& part : parts) EXPECT_TRUE(is_cutting(part, stock, tool, film));
}

TEST(CuttingParts, AirGoesAtTheEndsAndWhereItIsLonger) {
    const CuttingTool tool = ball_tool(6);
    HeightField stock = stock_of(400, 20, 0);
    stand(stock, 60, 80);
    stand(stock, 90, 100);
    stand(stock, 160, 170);
    const std::vector<Pass> parts = cutting_parts({line({5, 5, 2}, {195, 5, 2})}, stock, tool, film);
    ASSERT_EQ(parts.size(), 2U) << "10 mm of air are passed, 60 mm are left out";
    // A ball of 6 mm whose tip is at 2 reaches the foam of 5 from 3 mm beside it, and 1 mm more stays.
    EXPECT_NEAR(parts[0].points.front().tip.x, 56, 1);
    EXPECT_NEAR(parts[0].points.back().tip.x, 104, 1);
    EXPECT_NEAR(parts[1].points.front().tip.x, 156, 1);
    EXPECT_NEAR(parts[1].points.back().tip.x, 174, 1);
    EXPECT_TRUE(cutting_parts({line({5, 5, 5}, {195, 5, 5})}, stock, tool, film).empty()) << "over all of it";
    EXPECT_TRUE(cutting_parts({line({5, 5, 4.9}, {195, 5, 4.9})}, stock, tool, film).empty()) << "a film";
    EXPECT_FALSE(cutting_parts({line({5, 5, 4.7}, {195, 5, 4.7})}, stock, tool, film).empty());
}

// Foam on a wall that is thinner than a cell has no centre of a cell in it.
TEST(CuttingParts, AlongAWallAPassCounts) {
    const CuttingTool tool = ball_tool(6);
    HeightField stock = stock_of(200, 40, 0);
    for (std::size_t i = 0; i < stock.height.size(); ++i) {
        if (i / stock.columns < 10) stock.height[i] = 30;  // up to y = 5
    }
    const Pass along = line({10, 8.05, 5}, {90, 8.05, 5});
    EXPECT_EQ(depth(stock, {50, 8.05, 5}, 3), 0);
    EXPECT_TRUE(is_cutting(along, stock, tool, film));
    ASSERT_EQ(cutting_parts({along}, stock, tool, film).size(), 1U);
    EXPECT_EQ(length_of(cutting_parts({along}, stock, tool, film)), 80);
    EXPECT_FALSE(is_cutting(line({10, 9, 5}, {90, 9, 5}), stock, tool, film)) << "a millimetre beside it";
}

}  // namespace
}  // namespace qchopper
