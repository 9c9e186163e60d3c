// Which surface each direction finishes.

#include "cam/toolpath/finishing/finishing_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "segment/raster/square_dilation.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::bumpy;
using test_pieces::setup_of;

constexpr double cell = 0.5;
constexpr double near = 0.75;  // of a scallop height of 0.25 mm and a cell

HeightField closing_of(const Setup& setup, const TriangleMesh& mesh, std::size_t orientation, double diameter) {
    const CuttingTool tool = ball_tool(diameter);
    return remaining_surface(cl_surface(piece_height_field(setup, mesh, orientation, {cell, -6, 0}), tool), tool);
}

std::size_t cells_of(const FinishingRegion& region) {
    return static_cast<std::size_t>(
        std::count_if(region.begin(), region.end(), [](float z) { return z != not_finished; }));
}

TEST(RemainingSurface, IsTheClosing) {
    const TriangleMesh mesh = bumpy(40, 20, 50, 2);
    const auto setup = setup_of(mesh, 8);
    const HeightField target = piece_height_field(setup, mesh, 0, {1, -6, 0});
    const CuttingTool tool = ball_tool(9);
    const HeightField tip = cl_surface(target, tool);
    const HeightField closing = remaining_surface(tip, tool);
    for (std::size_t row = 0; row < tip.rows; ++row) {
        for (std::size_t column = 0; column < tip.columns; ++column) {
            float least = std::numeric_limits<float>::infinity();
            for (std::size_t r = 0; r < tip.rows; ++r) {
                for (std::size_t c = 0; c < tip.columns; ++c) {
                    const double distance = std::hypot(static_cast<double>(c) - static_cast<double>(column),
                                                       static_cast<double>(r) - static_cast<double>(row));
                    if (distance > 4.5) continue;
                    least = std::min(least, tip.at(c, r) + static_cast<float>(tool_profile(tool, distance)));
                }
            }
            ASSERT_EQ(closing.at(column, row), least);
            ASSERT_GE(closing.at(column, row), target.at(column, row));
        }
    }
}

TEST(RestMaterial, ASecondTimeNothingIsLeftToDo) {
    const TriangleMesh mesh = bumpy(40, 20, 20, 2);
    const auto setup = setup_of(mesh, 8);
    const HeightField closing = closing_of(setup, mesh, 0, 12);
    RestMaterial surface(mesh, qchopper::Setup());
    EXPECT_EQ(surface.share_within(0), 0);
    EXPECT_GT(cells_of(surface.take(closing, near, 1)), 5000U);
    EXPECT_EQ(cells_of(surface.take(closing, near, 1)), 0U);
}

TEST(RestMaterial, AnotherDirectionFinishesWhatTheFirstDoesNotSee) {
    // A slab on a post: under its overhang towards x only a tilted tool comes.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {60, 40, 10}), shapes::box({0, 0, 10.01}, {30, 40, 60})});
    TriangleMesh leaning = mesh;
    for (Vec3& p : leaning.points) {
        if (p.z > 59) p.x += 20;
    }
    const auto setup = setup_of(leaning, 30, 50);
    RestMaterial surface(leaning, qchopper::Setup());
    const FinishingRegion first = surface.take(closing_of(setup, leaning, 0, 12), near, 0);
    const double by_first = surface.share_within(0);
    const HeightField second_closing = closing_of(setup, leaning, 1, 12);
    const FinishingRegion second = surface.take(second_closing, near, 0);
    EXPECT_GT(surface.share_within(0), by_first + 0.1) << "the wall under the overhang";
    EXPECT_GT(cells_of(second), 1000U);
    // The top is seen from both and finished by the first.
    const Vec3 top = apply(second_closing.piece_in_field, {35, 20, 60});
    const auto at =
        static_cast<std::size_t>(top.y / cell) * second_closing.columns + static_cast<std::size_t>(top.x / cell);
    EXPECT_EQ(second[at], not_finished);
    EXPECT_GT(cells_of(first), 4000U);
}

TEST(RestMaterial, WhatIsGivenBackIsLeftToTheNextTake) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 20}, 4);
    const auto setup = setup_of(mesh, 8);
    const HeightField closing = closing_of(setup, mesh, 0, 12);
    // Over one half of the top there is foam after all.
    HeightField more = closing;
    for (std::size_t i = 0; i < more.height.size(); ++i) {
        const double x = (static_cast<double>(i % more.columns) + 0.5) * cell;
        if (x > 0.5 * cell * static_cast<double>(more.columns)) more.height[i] += 30;
    }
    RestMaterial surface(mesh, qchopper::Setup());
    EXPECT_EQ(surface.takes(), 0U);
    const std::size_t all = cells_of(surface.take(closing, near, 0));
    const double share = surface.share_within(0);
    EXPECT_FALSE(surface.give_back(1, closing, near));
    EXPECT_EQ(cells_of(surface.take(closing, near, 0)), 0U);
    EXPECT_FALSE(surface.give_back(2, more, near)) << "that take had nothing";
    EXPECT_TRUE(surface.give_back(1, more, near));
    EXPECT_NEAR(surface.share_within(0), 0.5 * share, 0.1);
    EXPECT_EQ(cells_of(surface.take(more, near, 0)), 0U) << "no better than what is known";
    const std::size_t again = cells_of(surface.take(closing, near, 0));
    EXPECT_NEAR(static_cast<double>(again), 0.5 * static_cast<double>(all), 0.1 * static_cast<double>(all));
    EXPECT_EQ(surface.share_within(0), share);
}

TEST(RestMaterial, AFinerToolGoesOnlyWhereMoreIsLeft) {
    // A groove of radius 4 is finished by a ball of radius 3 and not by one of radius 6.
    TriangleMesh mesh = bumpy(60, 120, 0, 1);
    for (Vec3& p : mesh.points) {
        if (p.z <= 0) continue;
        const double square = 16 - (p.x - 30) * (p.x - 30);
        p.z = square > 0.5 ? 20 - std::sqrt(square) : 20;
    }
    const auto setup = setup_of(mesh, 10);
    RestMaterial surface(mesh, qchopper::Setup());
    surface.take(closing_of(setup, mesh, 0, 12), near, 0);
    const HeightField fine = closing_of(setup, mesh, 0, 6);
    const FinishingRegion region = surface.take(fine, near, 0, 0.25);
    ASSERT_GT(cells_of(region), 200U);
    for (std::size_t i = 0; i < region.size(); ++i) {
        if (region[i] == not_finished) continue;
        const std::size_t row = i / fine.columns;
        const double x = (static_cast<double>(i % fine.columns) + 0.5) * cell;
        const double y = (static_cast<double>(row) + 0.5) * cell;
        const Vec3 p = apply_inverse(fine.piece_in_field, {x, y, static_cast<double>(region[i])});
        // In the groove, or at the outer walls, whose lowest millimetres a smaller ball reaches better.
        const bool is_at_wall = p.x < 2 || p.x > 58 || p.y < 2 || p.y > 58;
        EXPECT_TRUE(std::abs(p.x - 30) < 6 || is_at_wall) << p.x << ", " << p.y;
    }
}

TEST(RestMaterial, TheBaseAndWhatIsIgnoredAreLeftOut) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 10}, 4);
    const auto setup = setup_of(mesh, 8);
    const HeightField closing = closing_of(setup, mesh, 0, 12);
    mesh.ignored.assign(mesh.triangles.size(), 1);
    RestMaterial none(mesh, qchopper::Setup());
    EXPECT_EQ(cells_of(none.take(closing, near, 1)), 0U);
    EXPECT_EQ(none.share_within(0), 1);
}

TEST(RestMaterial, DoesNotDependOnThreads) {
    const TriangleMesh mesh = bumpy(40, 40, 40, 6);
    const auto setup = setup_of(mesh, 8);
    const HeightField closing = closing_of(setup, mesh, 0, 12);
    const FinishingRegion region = RestMaterial(mesh, qchopper::Setup()).take(closing, near, 1);
    for (const std::size_t threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(RestMaterial(mesh, qchopper::Setup()).take(closing, near, 1), region);
    }
}

TEST(FinishingRegion, GrowsToTheLowestAround) {
    std::mt19937 random(1);
    FinishingRegion region(37 * 23, not_finished);
    for (float& z : region) {
        if (random() % 9 == 0) z = static_cast<float>(random() % 100);
    }
    for (const std::size_t by : {0U, 1U, 2U, 5U, 30U}) {
        const FinishingRegion wide = erode_by_square(region, 37, 23, by);
        for (std::size_t row = 0; row < 23; ++row) {
            for (std::size_t column = 0; column < 37; ++column) {
                float least = not_finished;
                for (std::size_t r = row - std::min(row, by); r <= std::min<std::size_t>(row + by, 22); ++r) {
                    for (std::size_t c = column - std::min(column, by); c <= std::min<std::size_t>(column + by, 36);
                         ++c) {
                        least = std::min(least, region[r * 37 + c]);
                    }
                }
                ASSERT_EQ(wide[row * 37 + column], least) << by;
            }
        }
    }
}

// The block ends in the plane of a side of the box: there is no floor beyond it.
TEST(FloorBand, EndsAtASawnFace) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 20});
    auto setup = setup_of(mesh, 12);
    setup.block.size.x -= 12;
    setup.piece_in_setup.shift.x += 6;
    setup.box = {setup.box.min + Vec3{6, 0, 0}, setup.box.max + Vec3{6, 0, 0}};
    const HeightField target = piece_height_field(setup, mesh, 0, {cell, -6, 12});
    for (const bool is_sawn : {false, true}) {
        if (is_sawn) setup.flush_caps.push_back({1, BlockFace::plus_x, 400});
        FinishingRegion region(target.height.size(), not_finished);
        add_floor_band(region, target, 10, setup);
        std::size_t beside = 0;
        std::size_t beyond = 0;
        for (std::size_t i = 0; i < region.size(); ++i) {
            if (region[i] == not_finished) continue;
            const std::size_t row = i / target.columns;
            const double x = cell * (static_cast<double>(i % target.columns) + 0.5);
            const double y = cell * (static_cast<double>(row) + 0.5);
            ++(field_to_setup(setup, target, {x, y, 0}).x > setup.box.max.x ? beyond : beside);
        }
        EXPECT_GT(beside, 1000U);
        EXPECT_EQ(beyond == 0, is_sawn) << beyond;
    }
}

TEST(FinishingRegion, TheFloorBand) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 10});
    const auto setup = setup_of(mesh, 30);
    const HeightField target = piece_height_field(setup, mesh, 0, {cell, 0, 0});
    FinishingRegion region(target.height.size(), not_finished);
    add_floor_band(region, target, 12, qchopper::Setup());
    const auto at = [&](double x, double y) {
        const Vec3 p = apply(target.piece_in_field, {x, y, 0});
        return region[static_cast<std::size_t>(p.y / cell) * target.columns + static_cast<std::size_t>(p.x / cell)];
    };
    EXPECT_EQ(at(10, 10), not_finished);
    EXPECT_NE(at(-11, 10), not_finished);
    EXPECT_NE(at(31, 10), not_finished);
    EXPECT_EQ(at(-14, 10), not_finished);
}

}  // namespace
}  // namespace qchopper
