// Finishing passes, replayed on a grid: closed forms, no gouge, what is left, and the same for any number of threads.

#include "cam/toolpath/finishing/finishing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/finishing/scallop.h"
#include "cam/toolpath/pass_stretches.h"
#include "tests/cam/toolpath/replay.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::bumpy;
using test_pieces::deepest_gouge;
using test_pieces::foam_over;
using test_pieces::replayed;
using test_pieces::setup_of;
using test_pieces::surface_points;
using test_pieces::SurfacePoint;

constexpr double cell = 0.25;

TEST(ScallopHeight, EqualsTheClosedForms) {
    const double r = 6;
    const double s = 3;
    EXPECT_NEAR(scallop_height(r, s), 0.191, 5e-4);
    const auto bulge = [&](double rho) { return rho - std::sqrt(rho * rho - 0.25 * s * s); };
    EXPECT_NEAR(scallop_height(r, s, bulge(25 + r)), 0.154, 5e-4) << "convex, radius 25";
    const double bowl = 25 - std::sqrt(19 * 19 - 0.25 * s * s) - std::sqrt(r * r - 0.25 * s * s);
    EXPECT_NEAR(scallop_height(r, s, -bulge(25 - r)), bowl, 1e-9);
    const double slope = 1;
    EXPECT_NEAR(scallop_height(r, s / std::cos(slope)), r - std::sqrt(r * r - 9 / (4 * std::pow(std::cos(slope), 2))),
                1e-9);
    EXPECT_EQ(scallop_height(r, 2 * r), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(scallop_height(r, chord_for_scallop(r, 0.25)), 0.25, 1e-9);
}

// A piece finished from one direction of its setup.
struct Finished {
    HeightField target;
    HeightField tip;
    std::vector<Pass> passes;
    HeightField closing;
    HeightField left;
    std::vector<SurfacePoint> points;

    Finished(const TriangleMesh& mesh, std::size_t orientation, double tilt_deg, const FinishingOptions& options = {},
             std::optional<double> near = std::nullopt) {
        const auto setup = setup_of(mesh, 14, tilt_deg);
        const CuttingTool tool = ball_tool(12);
        target = piece_height_field(setup, mesh, orientation, {cell, -6, 0});
        tip = cl_surface(target, tool);
        closing = remaining_surface(tip, tool);
        RestMaterial surface(mesh, qchopper::Setup());
        const double as_none = near.value_or(0.5 * options.scallop + 0.75 * cell);
        passes = finishing_passes(tip, tool, surface.take(closing, as_none, 2), options);
        HeightField stock = target;
        std::fill(stock.height.begin(), stock.height.end(), 1e4F);
        left = replayed(stock, passes, tool);
        points = surface_points(mesh, target, 1);
    }
};

// Passes over tiles near to what is to be finished are those over the whole map.
TEST(FinishingPasses, OverTilesAreThoseOverTheWholeMap) {
    const TriangleMesh mesh = bumpy(60, 12, 60, 3);
    const auto setup = setup_of(mesh, 14, 35);
    const CuttingTool tool = ball_tool(6);
    const HeightField target = piece_height_field(setup, mesh, 1, {cell, -6, 0});
    const ToolDilation over_target(target, tool);
    FinishingOptions options;
    options.tool = &over_target;
    const HeightField whole = cl_surface(target, tool);
    // A small part of the surface.
    FinishingRegion region(target.height.size(), not_finished);
    FieldTiles tiles(target.columns, target.rows);
    for (std::size_t row = target.rows / 2; row < target.rows / 2 + 40; ++row) {
        for (std::size_t column = target.columns / 2; column < target.columns / 2 + 60; ++column) {
            const std::size_t i = row * target.columns + column;
            region[i] = target.height[i];
            tiles.add(i);
        }
    }
    const std::vector<Pass> expected = finishing_passes(whole, tool, region, options);
    tiles = tiles.grown(static_cast<std::size_t>(finishing_margin(tool, options, cell) / cell) + 1);
    options.tiles = &tiles;
    const HeightField tip = cl_surface(over_target, tiles);
    EXPECT_NE(tip.height, whole.height);
    const std::vector<Pass> found = finishing_passes(tip, tool, region, options);
    ASSERT_GT(expected.size(), 5U);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].points.size(), expected[k].points.size());
        for (std::size_t i = 0; i < found[k].points.size(); ++i) {
            ASSERT_EQ(found[k].points[i].tip, expected[k].points[i].tip);
        }
    }
}

// Over the points for which a condition holds.
struct Leftover {
    double most = 0;
    double mean = 0;
    std::size_t points = 0;
};

template <class Holds>
Leftover leftover(const Finished& finished, const Holds& holds) {
    Leftover result;
    for (const SurfacePoint& p : finished.points) {
        if (!holds(apply_inverse(finished.target.piece_in_field, p.at), p)) continue;
        const double foam = foam_over(finished.left, p, 10);
        result.most = std::max(result.most, foam);
        result.mean += foam;
        ++result.points;
    }
    result.mean /= static_cast<double>(std::max<std::size_t>(result.points, 1));
    return result;
}

// On a slope the CL surface is higher by up to the cell's diagonal, square to the surface, and what is left is only
// known at the centres of cells.
constexpr double cell_error = 2 * cell;

// How far the middle of the tool is from the walls of a block that is turned under the map, along all levels.
struct FromWalls {
    double least = 1e9;
    double most = 0;
    std::size_t points = 0;

    explicit FromWalls(bool knows_tool) {
        constexpr double wide_cell = 0.5;
        const Vec3 size{60, 40, 40};
        const double turn = 0.4;
        TriangleMesh mesh = shapes::box({0, 0, 0}, size);
        for (Vec3& p : mesh.points) p = turned(p, turn);
        const auto setup = setup_of(mesh, 14);
        const CuttingTool tool = ball_tool(12);
        const DilationOptions border{0, 0.075};
        const HeightField target = piece_height_field(setup, mesh, 0, {wide_cell, -6, 0});
        const HeightField tip = cl_surface(target, tool, border);
        const ToolDilation over_target(target, tool, border);
        RestMaterial surface(mesh, qchopper::Setup());
        FinishingOptions options;
        if (knows_tool) options.tool = &over_target;
        for (const Pass& pass :
             finishing_passes(tip, tool, surface.take(remaining_surface(tip, tool), 0.75, 2), options)) {
            for (std::size_t i = 1; i < pass.points.size(); ++i) {
                for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                    const Vec3 in_map = pass.points[i - 1].tip + share * (pass.points[i].tip - pass.points[i - 1].tip);
                    const Vec3 p = turned(apply_inverse(target.piece_in_field, in_map), -turn);
                    if (p.z < 2 || p.z > 30) continue;
                    const double from =
                        std::hypot(std::max({0.0, -p.x, p.x - size.x}), std::max({0.0, -p.y, p.y - size.y}));
                    least = std::min(least, from);
                    most = std::max(most, from);
                    ++points;
                }
            }
        }
    }

 private:
    static Vec3 turned(Vec3 p, double by) {
        return {std::cos(by) * p.x - std::sin(by) * p.y, std::sin(by) * p.x + std::cos(by) * p.y, p.z};
    }
};

TEST(Finishing, LevelsGoAlongWallsThatAreObliqueToTheMap) {
    const FromWalls known(true);
    EXPECT_GT(known.points, 1000U);
    EXPECT_GE(known.least, 6 - std::sqrt(2) * 0.075 - 0.02);
    // The far corner of a cell that the wall touches, without its border, a sixteenth of a cell and the path tolerance.
    EXPECT_LE(known.most, 6 + 0.5 * (std::cos(0.4) + std::sin(0.4)) - 0.075 + 0.05 + 0.1);
    EXPECT_LT(known.most, FromWalls(false).most - 0.2);
}

TEST(Finishing, AFlatTopHasTheScallopsOfItsStep) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 50, 20});
    const Finished finished(mesh, 0, 0);
    // Rows are the passes at one height over the top.
    std::vector<double> rows;
    for (const Pass& pass : finished.passes) {
        Vec3 low = apply_inverse(finished.target.piece_in_field, pass.points.front().tip);
        Vec3 high = low;
        for (const PassPoint& point : pass.points) {
            const Vec3 p = apply_inverse(finished.target.piece_in_field, point.tip);
            low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        if (high.z < 19.5 || high.z > 20.5) continue;
        if (high.x - low.x > 50 && high.y - low.y < 1e-6 && low.y > 5 && low.y < 45) rows.push_back(low.y);
        if (high.y - low.y > 45 && high.x - low.x < 1e-6 && low.x > 5 && low.x < 45) rows.push_back(low.x);
    }
    std::sort(rows.begin(), rows.end());
    ASSERT_GE(rows.size(), 8U);
    double step = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) step = std::max(step, rows[i] - rows[i - 1]);
    EXPECT_LE(step, finishing_stepover(ball_tool(12), {}) + 1e-9);
    EXPECT_GE(step, 0.9 * finishing_stepover(ball_tool(12), {})) << "no closer than needed";
    const Leftover top = leftover(finished, [](Vec3 p, const SurfacePoint& s) {
        return s.normal.z > 0.99 && p.x > 8 && p.x < 52 && p.y > 8 && p.y < 42;
    });
    ASSERT_GT(top.points, 500U);
    EXPECT_NEAR(top.most, scallop_height(6, step), cell);
    EXPECT_GE(top.mean, scallop_height(6, step) / 3 - 0.02) << "of a parabola";
    EXPECT_LE(top.mean, scallop_height(6, step) / 3 + 0.1) << "with points reduced";
}

// A block whose top is a plane of some slope, and with it the closed form of a slope across the passes.
TriangleMesh ramp(double slope_deg) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 90});
    for (Vec3& p : mesh.points) {
        if (p.z > 45) p.z = 10 + p.x * std::tan(slope_deg * 0.017453292519943295);
    }
    return mesh;
}

TEST(Finishing, RampsOfAnySlopeKeepTheScallopHeight) {
    const FinishingOptions options;
    for (const double slope : {10.0, 30.0, 45.0, 55.0, 70.0}) {
        for (const std::size_t orientation : {0U, 1U}) {
            if (orientation == 1 && slope > 40) continue;  // hardly seen from there
            const Finished finished(ramp(slope), orientation, 40);
            const Leftover over = leftover(finished, [&](Vec3 p, const SurfacePoint& s) {
                return s.normal.z > 0.1 && p.x > 10 && p.x < 50 && p.y > 8 && p.y < 32 && p.z > 10.5;
            });
            ASSERT_GT(over.points, 500U) << slope;
            EXPECT_LE(over.most, options.scallop + options.path_tolerance + cell_error) << slope << ", " << orientation;
            EXPECT_GE(over.most, 0.3 * options.scallop) << slope << ": passes far closer than needed";
        }
    }
}

TEST(Finishing, HemisphereAndBowl) {
    const FinishingOptions options;
    const TriangleMesh ball = shapes::ball({0, 0, 25}, 25, 64);
    // A bowl: the underside of a ball, cut into a block, as a grid of heights.
    TriangleMesh bowl = bumpy(60, 120, 0, 1);
    for (Vec3& p : bowl.points) {
        if (p.z <= 0) continue;
        const double square = 25 * 25 - (p.x - 30) * (p.x - 30) - (p.y - 30) * (p.y - 30);
        p.z = square > 49 ? 40 - std::sqrt(square) : 33;
    }
    for (const std::size_t orientation : {0U, 1U}) {
        const Finished convex(ball, orientation, 40);
        const Vec3 tool_axis = convex.target.tool_axis();
        const Leftover over_ball = leftover(convex, [&](Vec3 p, const SurfacePoint&) {
            return dot(p - Vec3{0, 0, 25}, tool_axis) > 5 && p.z > 8;
        });
        ASSERT_GT(over_ball.points, 500U);
        EXPECT_LE(over_ball.most, options.scallop + options.path_tolerance + cell_error);
        EXPECT_LE(deepest_gouge(convex.passes, ball_tool(12), convex.points, convex.target), 0.01);
        const Finished concave(bowl, orientation, 20);
        const Vec3 in_out = concave.target.tool_axis();
        const Leftover in_bowl = leftover(concave, [&](Vec3 p, const SurfacePoint&) {
            const Vec3 from_middle = p - Vec3{30, 30, 40};
            return norm(from_middle) < 25.5 && dot(from_middle, in_out) < -13;
        });
        ASSERT_GT(in_bowl.points, 500U);
        EXPECT_LE(in_bowl.most, options.scallop + options.path_tolerance + cell_error);
        EXPECT_LE(deepest_gouge(concave.passes, ball_tool(12), concave.points, concave.target), 0.01);
    }
}

TEST(Finishing, BumpyPiecesAreNeverGougedAndLittleIsLeft) {
    FinishingOptions options;
    options.rounding = 3;
    for (const unsigned seed : {1U, 2U, 3U}) {
        const TriangleMesh mesh = bumpy(60, 40, 60, seed);
        const Finished finished(mesh, seed % 2, 40, options);
        EXPECT_LE(deepest_gouge(finished.passes, ball_tool(12), finished.points, finished.target), 0.01) << seed;
        double reachable = 0;
        double within = 0;
        double within_bound = 0;
        for (const SurfacePoint& p : finished.points) {
            if (foam_over(finished.closing, p, 1) > 0.5 * options.scallop + 0.75 * cell) continue;
            reachable += p.area;
            const double foam = foam_over(finished.left, p, 10);
            if (foam <= options.scallop + 0.5) within += p.area;
            if (foam <= options.scallop + options.path_tolerance + 2 * cell + 0.5) within_bound += p.area;
        }
        EXPECT_GE(within, 0.995 * reachable) << seed;
        EXPECT_GE(within_bound, 0.9995 * reachable) << seed;
    }
}

// Short passes are left out only where a longer one comes within a few steps.
TEST(Finishing, NoShortPassStandsBesideALongerOne) {
    const FinishingOptions options;
    const CuttingTool tool = ball_tool(12);
    const double stepover = finishing_stepover(tool, options);
    const Finished finished(bumpy(60, 40, 60, 1), 1, 40, options);
    const auto is_short = [&](const Pass& pass) { return !pass.is_closed && length_of(pass) < 0.75 * stepover; };
    ASSERT_GT(finished.passes.size(), 20U);
    for (const Pass& pass : finished.passes) {
        if (!is_short(pass)) continue;
        for (const Pass& other : finished.passes) {
            if (is_short(other)) continue;
            for (const PassPoint& point : other.points) {
                const Vec3 away = point.tip - pass.points.front().tip;
                EXPECT_GT(std::hypot(away.x, away.y), stepover);
            }
        }
    }
}

// Under a ball that floats there is nothing to finish but what stands on the floor within a tool's width of it.
TEST(Finishing, TheFloorIsClearedWithoutTheWallBesideIt) {
    const TriangleMesh mesh = shapes::ball({0, 0, 80}, 25, 48);
    const auto setup = setup_of(shapes::box({-25, -25, 0}, {25, 25, 105}), 20);
    const CuttingTool tool = ball_tool(12);
    const HeightField target = piece_height_field(setup, mesh, 0, {cell, -6, 0});
    const HeightField tip = cl_surface(target, tool);
    const FinishingRegion region = RestMaterial(mesh, qchopper::Setup()).take(remaining_surface(tip, tool), 0.5, 3);
    FinishingRegion floor(region.size(), not_finished);
    add_floor_band(floor, target, 12, qchopper::Setup());
    FinishingOptions options;
    options.floor = &floor;
    const double floor_z = setup_to_field(setup, target, {0, 0, -6}).z;
    const std::vector<Pass> passes = finishing_passes(tip, tool, region, options);
    for (const Pass& pass : passes) {
        for (const PassPoint& point : pass.points) {
            const double over = point.tip.z - floor_z;
            EXPECT_TRUE(over < 6 || over > 50) << over;
        }
    }
    HeightField stock = target;
    std::fill(stock.height.begin(), stock.height.end(), 1e4F);
    const HeightField left = replayed(stock, passes, tool);
    const double base_z = floor_z + 6;
    std::size_t seen = 0;
    for (std::size_t row = 0; row < left.rows; ++row) {
        for (std::size_t column = 0; column < left.columns; ++column) {
            const Vec3 in_map{(static_cast<double>(column) + 0.5) * cell, (static_cast<double>(row) + 0.5) * cell, 0};
            const Vec3 p = apply_inverse(target.piece_in_field, in_map);
            const double from_wall = std::hypot(p.x, p.y) - 25;
            if (from_wall < 3 * cell || from_wall > 11) continue;
            ++seen;
            EXPECT_LE(static_cast<double>(left.at(column, row)), base_z + cell) << from_wall;
        }
    }
    EXPECT_GT(seen, 10'000U);
}

// Walls on both sides of a piece that lean out by a degree under an edge that descends by 60: from above a tool that
// goes along the edge passes the strip under it at less than the tolerance, and mills it.
TEST(Finishing, TheStripUnderAnOverhangingEdgeIsMilled) {
    constexpr double lean = 0.02;  // per mm of height
    const auto edge_z = [](double x) { return 70 - 1.7 * x; };
    TriangleMesh mesh = shapes::box({-30, -20, 0}, {30, 20, 100}, 40);
    for (Vec3& p : mesh.points) {
        p.z *= edge_z(p.x) / 100;
        p.y += (p.y > 0 ? 1 : -1) * lean * p.z;
    }
    const FinishingOptions options;
    const Finished finished(mesh, 0, 0, options, options.scallop + cell);
    std::size_t passed = 0;
    std::size_t milled = 0;
    for (const double side : {-1.0, 1.0}) {
        const Vec3 normal = rotate(finished.target.piece_in_field, normalized(Vec3{0, side, -lean}));
        for (double x = -25; x < 25; x += 0.5) {
            for (double under = 0.25; under < 30; under += 0.25) {
                const double z = edge_z(x) - under;
                const Vec3 at = apply(finished.target.piece_in_field, {x, side * (20 + lean * z), z});
                const SurfacePoint point{at, normal, 1};
                if (foam_over(finished.closing, point, 1) > options.scallop + 0.75 * cell) continue;
                ++passed;
                if (foam_over(finished.left, point, 10) <= options.scallop + 0.5) ++milled;
            }
        }
    }
    EXPECT_GT(passed, 5000U);
    EXPECT_GE(static_cast<double>(milled), 0.995 * static_cast<double>(passed));
}

TEST(Finishing, NoPassIsBelowTheClSurface) {
    const TriangleMesh mesh = bumpy(50, 30, 70, 9);
    const Finished finished(mesh, 1, 30);
    const CuttingTool tool = ball_tool(12);
    for (const Pass& pass : finished.passes) {
        for (const PassPoint& point : pass.points) {
            const auto column = static_cast<std::size_t>(point.tip.x / cell);
            const auto row = static_cast<std::size_t>(point.tip.y / cell);
            // Of the centres around the point the lowest.
            float lowest = finished.tip.at(column, row);
            for (std::size_t r = row - 1; r <= row + 1; ++r) {
                for (std::size_t c = column - 1; c <= column + 1; ++c) lowest = std::min(lowest, finished.tip.at(c, r));
            }
            ASSERT_GE(point.tip.z, static_cast<double>(lowest) - 1e-3);
        }
    }
}

TEST(Finishing, DoesNotDependOnThreads) {
    const TriangleMesh mesh = bumpy(50, 30, 50, 4);
    const Finished one(mesh, 1, 30);
    for (const std::size_t threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        const Finished other(mesh, 1, 30);
        ASSERT_EQ(other.passes.size(), one.passes.size());
        EXPECT_EQ(other.target.height, one.target.height);
        for (std::size_t i = 0; i < one.passes.size(); ++i) {
            ASSERT_EQ(other.passes[i].points.size(), one.passes[i].points.size());
            for (std::size_t k = 0; k < one.passes[i].points.size(); ++k) {
                ASSERT_EQ(other.passes[i].points[k].tip, one.passes[i].points[k].tip);
                ASSERT_EQ(other.passes[i].points[k].is_rounded, one.passes[i].points[k].is_rounded);
            }
        }
    }
}

TEST(Finishing, AnEmptyRegionHasNoPasses) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {30, 30, 10});
    const auto setup = setup_of(mesh);
    const HeightField tip = cl_surface(piece_height_field(setup, mesh, 0, {1, -6, 0}), ball_tool(12));
    EXPECT_TRUE(finishing_passes(tip, ball_tool(12), FinishingRegion(tip.height.size(), not_finished), {}).empty());
}

TEST(Finishing, ValuesThatMakeNoSenseAreNamed) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {30, 30, 10});
    const auto setup = setup_of(mesh);
    const HeightField tip = cl_surface(piece_height_field(setup, mesh, 0, {1, -6, 0}), ball_tool(12));
    const FinishingRegion region(tip.height.size(), 0.0F);
    const auto named = [&](const FinishingOptions& options, const CuttingTool& tool) -> std::string {
        try {
            finishing_passes(tip, tool, region, options);
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use);
            return error.what();
        }
        return "";
    };
    for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_NE(named({wrong}, ball_tool(12)).find("scallop"), std::string::npos);
        EXPECT_NE(named({0.25, wrong}, ball_tool(12)).find("path_tolerance"), std::string::npos);
    }
    EXPECT_NE(named({0.25, 0.1, -1}, ball_tool(12)).find("rounding"), std::string::npos);
    EXPECT_NE(named({0.25, 0.1, 0, 90}, ball_tool(12)).find("steep_deg"), std::string::npos);
    EXPECT_NE(named({7}, ball_tool(12)).find("scallop"), std::string::npos);
    EXPECT_NE(named({}, test_pieces::flat_tool(12)).find("tool"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
