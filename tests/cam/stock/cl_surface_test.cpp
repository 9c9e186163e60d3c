// Piece height fields and CL surfaces: against plain loops, against points of the triangles, and closed forms.

#include "cam/stock/cl_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/error.h"
#include "base/parallel.h"
#include "cam/setup/holder_clearance.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "segment/raster/bilinear_cell.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::bumpy;
using test_pieces::flat_tool;
using test_pieces::setup_of;

// A point of a triangle, evenly distributed.
Vec3 point_of(const TriangleMesh& mesh, std::size_t triangle, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    double u = unit(random);
    double v = unit(random);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const auto& t = mesh.triangles[triangle];
    return mesh.points[t[0]] + u * (mesh.points[t[1]] - mesh.points[t[0]]) +
           v * (mesh.points[t[2]] - mesh.points[t[0]]);
}

TEST(PieceHeightField, NoPointOfThePieceIsAboveItsCell) {
    std::mt19937 random(1);
    for (const double tilt : {1.0, 40.0, 90.0}) {
        TriangleMesh mesh = bumpy(40, 23, 30, 5);
        const auto setup = setup_of(mesh, 5, tilt);
        const HeightField map = piece_height_field(setup, mesh, 1, {0.7, -3, 2});
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            for (int k = 0; k < 20; ++k) {
                const Vec3 p = apply(map.piece_in_field, point_of(mesh, t, random));
                const auto column = static_cast<std::size_t>(p.x / map.cell);
                const auto row = static_cast<std::size_t>(p.y / map.cell);
                ASSERT_LE(p.z, static_cast<double>(map.at(column, row)) + 1e-9);
            }
        }
    }
}

TEST(PieceHeightField, MapsOfDifferentCellsShareTheirFrame) {
    const TriangleMesh mesh = bumpy(40, 23, 30, 5);
    const auto setup = setup_of(mesh, 5, 40);
    const HeightField fine = piece_height_field(setup, mesh, 1, {0.25, -3, 2});
    const HeightField coarse = piece_height_field(setup, mesh, 1, {5.0 / 3, 0, 2});
    EXPECT_EQ(fine.piece_in_field, coarse.piece_in_field);
}

TEST(PieceHeightField, ACellIsAsHighAsTheHighestPointOverIt) {
    // A ramp: the highest point over a cell is at its far side; a needle thinner than a cell is found all the same.
    TriangleMesh ramp = shapes::box({0, 0, 0}, {20, 20, 10});
    for (Vec3& p : ramp.points) {
        if (p.z > 5) p.z = 5 + 0.25 * p.x;
    }
    const auto setup = setup_of(ramp);
    const HeightField map = piece_height_field(setup, ramp, 0, {0.5, 0, 0});
    for (double x = 0.1; x < 20; x += 0.5) {
        const Vec3 p = apply(map.piece_in_field, {x, 10.1, 0});
        const auto column = std::floor(p.x / map.cell);
        const auto row = static_cast<std::size_t>(p.y / map.cell);
        // Of both corners of the cell towards larger x of the piece.
        double most = 0;
        for (const double side : {0.0, 1.0}) {
            for (const double other : {0.0, 1.0}) {
                const Vec3 corner{(column + side) * map.cell, (static_cast<double>(row) + other) * map.cell, 0};
                most = std::max(most, 5 + 0.25 * std::min(20.0, apply_inverse(map.piece_in_field, corner).x));
            }
        }
        const Vec3 top =
            field_to_setup(setup, map, {0, 0, static_cast<double>(map.at(static_cast<std::size_t>(column), row))});
        EXPECT_NEAR(top.z, most, 1e-4);
    }
    const TriangleMesh needle =
        shapes::joined({shapes::box({0, 0, 0}, {20, 20, 2}), shapes::box({7.31, 8.32, 2.5}, {7.33, 8.34, 9})});
    const auto with_needle = setup_of(needle);
    const HeightField thin = piece_height_field(with_needle, needle, 0, {0.5, 0, 0});
    const Vec3 p = apply(thin.piece_in_field, {7.32, 8.33, 9});
    EXPECT_NEAR(p.z, thin.at(static_cast<std::size_t>(p.x / 0.5), static_cast<std::size_t>(p.y / 0.5)), 1e-4);
}

TEST(PieceHeightField, TheFloorIsAPlaneOfTheSetup) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 10});
    for (const double tilt : {30.0, 60.0}) {
        const auto setup = setup_of(mesh, 20, tilt);
        const HeightField map = piece_height_field(setup, mesh, 1, {0.5, -6, 3});
        std::size_t on_floor = 0;
        for (std::size_t row = 0; row < map.rows; ++row) {
            for (std::size_t column = 0; column < map.columns; ++column) {
                const double z = map.at(column, row);
                ASSERT_TRUE(std::isfinite(z));
                const Vec3 p = field_to_setup(
                    setup, map, {0.5 * (static_cast<double>(column) + 0.5), 0.5 * (static_cast<double>(row) + 0.5), z});
                // Outside of the block the floor may end at its highest and lowest points.
                if (std::abs(p.x) > 0.5 * setup.block.size.x || std::abs(p.y) > 0.5 * setup.block.size.y) continue;
                ASSERT_GE(p.z, -6 - 1e-4);
                if (p.z < -6 + 0.5) ++on_floor;
            }
        }
        EXPECT_GT(on_floor, 1000U);
    }
}

// However the piece lies in its own coordinates.
TEST(PieceHeightField, RowsLieAlongTheSidesOfTheBlock) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 20, 10});
    for (const double turn : {0.0, 0.5, 2.0}) {
        auto setup = setup_of(mesh, 5);
        const Pose turned{{Vec3{std::cos(turn), -std::sin(turn), 0}, {std::sin(turn), std::cos(turn), 0}, {0, 0, 1}},
                          {}};
        setup.piece_in_setup = setup.piece_in_setup * inverse(turned);
        const HeightField map = piece_height_field(setup, apply(turned, mesh), 0, {0.5, 0, 3});
        const Vec3 side = field_to_setup(setup, map, {1, 0, 0}) - field_to_setup(setup, map, {});
        EXPECT_NEAR(norm(side - Vec3{1, 0, 0}), 0, 1e-12);
        EXPECT_NEAR(0.5 * static_cast<double>(map.columns), setup.block.size.x + 6, 1);
        EXPECT_NEAR(0.5 * static_cast<double>(map.rows), setup.block.size.y + 6, 1);
    }
}

TEST(ToolDilation, LeavesOutOnlyWhatBoundsSay) {
    const TriangleMesh mesh = bumpy(40, 20, 50, 2);
    const HeightField target = piece_height_field(setup_of(mesh, 8), mesh, 0, {1, -6, 0});
    const ToolDilation dilation(target, ball_tool(9), {0, 0.1});
    double x = 0;
    double y = 0;
    for (int k = 0; k < 500; ++k) {
        x = std::fmod(x + 17.23, static_cast<double>(target.columns) + 6) - 3;
        y = std::fmod(y + 7.61, static_cast<double>(target.rows) + 6) - 3;
        const double height = dilation.height(x, y);
        EXPECT_EQ(dilation.height(x, y, {height - 1, height + 1}), height);
        EXPECT_EQ(dilation.height(x, y, {height + 1, height + 2}), height + 1);
        const double bounded = dilation.height(x, y, {height - 3, height - 2});
        EXPECT_TRUE(height - 2 <= bounded && bounded <= height);
    }
}

TEST(ToolDilation, TellsHeightsBetweenTheMiddlesOfCellsToo) {
    const TriangleMesh mesh = bumpy(40, 20, 50, 2);
    const HeightField target = piece_height_field(setup_of(mesh, 8), mesh, 0, {1, -6, 0});
    const DilationOptions options{0.3, 0.1};
    const ToolDilation dilation(target, ball_tool(9), options);
    const HeightField tip = cl_surface(target, ball_tool(9), options);
    for (std::size_t row = 0; row < tip.rows; ++row) {
        for (std::size_t column = 0; column < tip.columns; ++column) {
            const double x = static_cast<double>(column) + 0.5;
            const double y = static_cast<double>(row) + 0.5;
            ASSERT_NEAR(dilation.height(x, y), static_cast<double>(tip.at(column, row)), 1e-4);
            ASSERT_TRUE(is_of_tool(tip, dilation, row * tip.columns + column));
        }
    }
    // A post of 10 mm on a floor, of a cell that is 0.8 mm wide without its border: the ball touches it at its side.
    HeightField post;
    post.cell = 1;
    post.columns = 21;
    post.rows = 21;
    post.height.assign(441, 0);
    post.height[10 * 21 + 10] = 10;
    const ToolDilation beside(post, ball_tool(9), {0, 0.1});
    for (double far = 0.45; far < 5.4; far += 0.05) {
        const double from_side = std::max(0.0, far - 0.4);
        const double expected = from_side > 4.5 ? 0 : std::max(0.0, 10 - tool_profile(ball_tool(9), from_side));
        EXPECT_NEAR(beside.height(10.5 + far, 10.5), expected, 1e-9) << far;
    }
    HeightField raised = cl_surface(post, ball_tool(9), {0, 0.1});
    raised.height[0] += 1;
    EXPECT_FALSE(is_of_tool(raised, beside, 0));
}

TEST(ToolDilation, NoHeightBetweenFourMiddlesIsAboveAllOfTheirs) {
    const TriangleMesh mesh = bumpy(40, 20, 50, 2);
    const HeightField target = piece_height_field(setup_of(mesh, 8), mesh, 0, {1, -6, 0});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    for (const CuttingTool& tool : {ball_tool(9), flat_tool(9)}) {
        for (const double border : {0.0, 0.1, 0.5}) {
            const ToolDilation dilation(target, tool, {0.2, border});
            const HeightField tip = cl_surface(target, tool, {0.2, border});
            for (int k = 0; k < 3000; ++k) {
                const double x = share(random) * static_cast<double>(tip.columns);
                const double y = share(random) * static_cast<double>(tip.rows);
                double highest = -std::numeric_limits<double>::infinity();
                for (const std::size_t cell : BilinearCell(tip, x, y).cells) {
                    highest = std::max(highest, static_cast<double>(tip.height[cell]));
                }
                ASSERT_LE(dilation.height(x, y), highest + 1e-4) << x << " " << y << " " << border;
            }
        }
    }
}

TEST(PieceHeightField, ValuesThatAreNoLengthsAreRefused) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 10});
    const auto setup = setup_of(mesh);
    const double no_number = std::nan("");
    for (const PieceHeightFieldOptions& options :
         {PieceHeightFieldOptions{0, 0, 0}, PieceHeightFieldOptions{-1, 0, 0}, PieceHeightFieldOptions{no_number, 0, 0},
          PieceHeightFieldOptions{1, 0, -1}, PieceHeightFieldOptions{1, no_number, 0},
          PieceHeightFieldOptions{1e-5, 0, 0}}) {
        EXPECT_THROW(piece_height_field(setup, mesh, 0, options), InputError);
    }
    EXPECT_THROW(cl_surface(piece_height_field(setup, mesh, 0, {}), ball_tool(12), {-1}), InputError);
}

TEST(ToolProfile, Shapes) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(tool_profile(ball_tool(12), 0), 0);
    EXPECT_NEAR(tool_profile(ball_tool(12), 3), 6 - std::sqrt(27.0), 1e-12);
    EXPECT_EQ(tool_profile(ball_tool(12), 6.001), inf);
    EXPECT_EQ(tool_profile(flat_tool(12), 5.9), 0);
    CuttingTool bull = flat_tool(12);
    bull.shape = ToolShape::bull;
    bull.corner_radius = 2;
    EXPECT_EQ(tool_profile(bull, 4), 0);
    EXPECT_NEAR(tool_profile(bull, 6), 2, 1e-12);
    EXPECT_NEAR(tool_profile(bull, 5), 2 - std::sqrt(3.0), 1e-12);
    CuttingTool cone = ball_tool(12);
    cone.shape = ToolShape::cone;
    cone.corner_radius = 0;
    cone.tip_angle = std::numbers::pi / 2;
    EXPECT_NEAR(tool_profile(cone, 5), 5, 1e-12);
    cone.corner_radius = 1;
    const double tangent = std::sqrt(0.5);
    EXPECT_NEAR(tool_profile(cone, tangent), 1 - tangent, 1e-9);
    EXPECT_NEAR(tool_profile(cone, 5), 1 - tangent + 5 - tangent, 1e-9);
}

HeightField spiky_map(std::size_t columns, std::size_t rows, double cell, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    HeightField map;
    map.cell = cell;
    map.columns = columns;
    map.rows = rows;
    map.height.resize(columns * rows);
    // Mostly gentle, with a few spikes and holes.
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        const float u = unit(random);
        map.height[i] = std::sin(0.1F * static_cast<float>(i % columns)) + 0.2F * u;
        if (u > 0.99F) map.height[i] += 20 * unit(random);
        if (u < 0.02F) map.height[i] = HeightField::nothing;
    }
    return map;
}

// The definition.
float plain_tip(const HeightField& map, const CuttingTool& tool, std::size_t column, std::size_t row) {
    float tip = HeightField::nothing;
    for (std::size_t r = 0; r < map.rows; ++r) {
        for (std::size_t c = 0; c < map.columns; ++c) {
            const auto past = [&](std::size_t a, std::size_t b) {
                return std::max(0.0, std::abs(static_cast<double>(a) - static_cast<double>(b)) - 0.5) * map.cell;
            };
            const double distance = std::hypot(past(c, column), past(r, row));
            if (distance > 0.5 * tool.diameter) continue;
            tip = std::max(tip, map.at(c, r) + static_cast<float>(-tool_profile(tool, distance)));
        }
    }
    return tip;
}

TEST(ClSurface, EqualsTheDefinition) {
    CuttingTool bull = flat_tool(7);
    bull.shape = ToolShape::bull;
    bull.corner_radius = 1.5;
    CuttingTool cone = ball_tool(8);
    cone.shape = ToolShape::cone;
    cone.corner_radius = 0.5;
    cone.tip_angle = 1;
    for (const CuttingTool& tool : {ball_tool(12), flat_tool(6), bull, cone, ball_tool(0.4)}) {
        const HeightField map = spiky_map(163, 61, 0.5, 7);
        const HeightField tip = cl_surface(map, tool);
        for (std::size_t row = 0; row < map.rows; row += 3) {
            for (std::size_t column = 0; column < map.columns; ++column) {
                ASSERT_EQ(tip.at(column, row), plain_tip(map, tool, column, row)) << column << ", " << row;
            }
        }
        std::vector<float> part(70);
        ToolDilation(map, tool).fill(30, 41, 111, part.data());
        for (std::size_t c = 0; c < part.size(); ++c) ASSERT_EQ(part[c], tip.at(41 + c, 30));
    }
}

FieldTiles some_tiles(const HeightField& map, unsigned seed) {
    FieldTiles tiles(map.columns, map.rows);
    std::mt19937 random(seed);
    for (int k = 0; k < 12; ++k) tiles.add(random() % map.height.size());
    return tiles;
}

TEST(ClSurface, InTilesIsThatOfTheWholeMapAndElsewhereNotBelowIt) {
    const HeightField map = spiky_map(163, 121, 0.5, 7);
    for (const CuttingTool& tool : {ball_tool(12), flat_tool(6), ball_tool(0.4)}) {
        const DilationOptions options{0.7, 0.1};
        const HeightField whole = cl_surface(map, tool, options);
        const FieldTiles tiles = some_tiles(map, 3);
        const HeightField tip = cl_surface(ToolDilation(map, tool, options), tiles);
        std::size_t held = 0;
        for (std::size_t i = 0; i < map.height.size(); ++i) {
            if (tiles.holds(i)) {
                ++held;
                ASSERT_EQ(tip.height[i], whole.height[i]) << i;
            } else {
                ASSERT_GE(tip.height[i], whole.height[i]) << i;
            }
        }
        EXPECT_GT(held, 1000U);
        EXPECT_LT(held, map.height.size() / 2);
    }
}

TEST(ClSurface, WhatRemainsInTilesIsThatOfTheWholeMap) {
    const HeightField map = spiky_map(163, 121, 0.5, 7);
    const CuttingTool tool = ball_tool(12);
    const FieldTiles tiles = some_tiles(map, 4);
    const HeightField whole = remaining_surface(cl_surface(map, tool), tool);
    // Tips within the radius of a tile, and no others, are needed for it.
    const HeightField tip = cl_surface(ToolDilation(map, tool), tiles.grown(13));
    const HeightField remaining = remaining_surface(tip, tool, tiles);
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        ASSERT_EQ(remaining.height[i], tiles.holds(i) ? whole.height[i] : std::numeric_limits<float>::infinity()) << i;
    }
}

TEST(ClSurface, HeightsAlongPlacesAreTheGreatestSoFar) {
    const HeightField map = spiky_map(163, 121, 0.5, 9);
    const ToolDilation tool(map, ball_tool(12), {0.3, 0.05});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int k = 0; k < 200; ++k) {
        const Point2 first{80 * unit(random), 60 * unit(random)};
        std::vector<Point2> places;
        for (int i = 0; i < 7; ++i) places.push_back({first.x + 0.07 * i, first.y - 0.03 * i});
        const double low = tool.height(first.x, first.y) - 4 * unit(random);
        std::vector<float> heights(places.size());
        tool.heights_along(places, {low, std::numeric_limits<double>::infinity()}, heights);
        auto highest = static_cast<float>(low);
        for (std::size_t i = 0; i < places.size(); ++i) {
            highest = std::max(highest, static_cast<float>(tool.height(places[i].x, places[i].y)));
            ASSERT_EQ(heights[i], highest);
        }
    }
}

TEST(ClSurface, ABorderOfCellsCutsIntoAPeakByItsDiagonalAtMost) {
    HeightField map = spiky_map(81, 81, 0.25, 7);
    std::fill(map.height.begin(), map.height.end(), -100.0F);
    map.height[40 * map.columns + 40] = 0;
    const CuttingTool tool = ball_tool(12);
    const double border = 0.075;
    const HeightField tip = cl_surface(map, tool, {0, border});
    double deepest = 0;
    for (std::size_t row = 0; row < map.rows; ++row) {
        for (std::size_t column = 0; column < map.columns; ++column) {
            // The point of the peak's cell that is nearest to the axis.
            const auto past = [&](std::size_t a) { return std::max(0.0, std::abs(static_cast<double>(a) - 40) - 0.5); };
            const double aside = map.cell * std::hypot(past(column), past(row));
            const double below = static_cast<double>(tip.at(column, row)) + 6;
            deepest = std::max(deepest, 6 - std::hypot(aside, below));
        }
    }
    EXPECT_LE(deepest, std::sqrt(2.0) * border + 1e-6);
    EXPECT_GT(deepest, border);
    EXPECT_THROW(cl_surface(map, tool, {0, -0.1}), InputError);
}

TEST(ClSurface, DoesNotDependOnThreads) {
    const HeightField map = spiky_map(300, 200, 0.5, 8);
    const HeightField tip = cl_surface(map, ball_tool(12), {1.5});
    for (const std::size_t threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(cl_surface(map, ball_tool(12), {1.5}).height, tip.height);
    }
}

TEST(ClSurface, AllowanceIsADistance) {
    // Over a ball of radius 10, a ball tool of radius 6 that stays 2 away is one of radius 8 whose tip is 2 higher.
    const TriangleMesh mesh = shapes::ball({0, 0, 10}, 10, 64);
    const auto setup = setup_of(mesh, 20);
    const HeightField map = piece_height_field(setup, mesh, 0, {0.25, -5, 0});
    const HeightField tip = cl_surface(map, ball_tool(12), {2});
    for (std::size_t k = 0; k < 60; ++k) {
        const std::size_t column = map.columns / 2 + k;
        const double x = 0.25 * (static_cast<double>(column) + 0.5) - apply(map.piece_in_field, Vec3{0, 0, 0}).x;
        const Vec3 p = field_to_setup(setup, map, {0, 0, static_cast<double>(tip.at(column, map.rows / 2))});
        const double exact = 10 + std::sqrt(18 * 18 - x * x) - 6;
        // Never lower; higher by no more than the slope times the cell's half diagonal twice.
        EXPECT_GE(p.z, exact - 0.02);
        EXPECT_LE(p.z, exact + 0.5 * x / std::sqrt(18 * 18 - x * x) + 0.1) << x;
    }
}

// The ball stands over the centres of cells: no point of a triangle is nearer to its centre than its radius.
TEST(ClSurface, CutsIntoNoTriangle) {
    std::mt19937 random(3);
    for (const unsigned seed : {1U, 2U, 3U}) {
        const TriangleMesh mesh = bumpy(40, 17, 60, seed);
        const auto setup = setup_of(mesh, 8, 35);
        const HeightField map = piece_height_field(setup, mesh, seed % 2, {0.5, -5, 0});
        const HeightField tip = cl_surface(map, ball_tool(10));
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 p = apply(map.piece_in_field, point_of(mesh, t, random));
            const auto column = static_cast<std::ptrdiff_t>(p.x / map.cell);
            const auto row = static_cast<std::ptrdiff_t>(p.y / map.cell);
            for (std::ptrdiff_t r = row - 11; r <= row + 11; ++r) {
                for (std::ptrdiff_t c = column - 11; c <= column + 11; ++c) {
                    if (r < 0 || c < 0 || r >= static_cast<std::ptrdiff_t>(map.rows) ||
                        c >= static_cast<std::ptrdiff_t>(map.columns))
                        continue;
                    const double z = tip.at(static_cast<std::size_t>(c), static_cast<std::size_t>(r));
                    const Vec3 centre{(static_cast<double>(c) + 0.5) * map.cell,
                                      (static_cast<double>(r) + 0.5) * map.cell, z + 5};
                    ASSERT_GE(norm(p - centre), 5 - 1e-4);
                }
            }
        }
    }
}

TEST(ClSurface, TheHolderStaysClear) {
    // A post of 60 mm; with 40 mm of stick-out the holder may not come within its radius of the post.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {120, 120, 5}), shapes::box({50, 50, 5.5}, {60, 60, 60})});
    const auto setup = setup_of(mesh, 10);
    const HeightField map = piece_height_field(setup, mesh, 0, {0.5, 0, 0});
    HeightField tip = cl_surface(map, ball_tool(12));
    const ToolBody body{40, {{50, 60}}};
    EXPECT_TRUE(raise_to_holder(tip, map, body, setup.piece_in_setup));
    const auto height_at = [&](double x, double y) {
        const Vec3 p = apply(map.piece_in_field, {x, y, 0});
        return field_to_setup(setup, map,
                              {0, 0,
                               static_cast<double>(
                                   tip.at(static_cast<std::size_t>(p.x / 0.5), static_cast<std::size_t>(p.y / 0.5)))})
            .z;
    };
    EXPECT_GE(height_at(84.5, 55), 20 - 1e-3) << "24.5 mm from the post";
    EXPECT_GE(height_at(30, 55), 20 - 1e-3);
    EXPECT_NEAR(height_at(84.5 + 6, 55), 5, 1e-3) << "clear of it";
    EXPECT_FALSE(raise_to_holder(tip, map, ToolBody{40, {}}, setup.piece_in_setup));
}

}  // namespace
}  // namespace qchopper
