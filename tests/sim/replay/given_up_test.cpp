// What must be milled follows from the piece, the directions of the setup and the tools of the cell, whatever the
// program does: a bar with a groove that only the finest ball enters, and a notch that only a tilted tool sees.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>

#include "sim/replay/leftover.h"
#include "sim/replay/reach/reachable.h"
#include "sim/replay/volumes.h"
#include "tests/cam/cell/short_tools.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::uint16_t flat_20 = 2;  // numbers of kr60-ha
constexpr std::uint16_t ball_12 = 3;
constexpr std::uint16_t ball_6 = 4;
constexpr double tall = 22;
constexpr double length = 43;
constexpr double groove_floor = 14;

// 70 mm wide, with a groove of 8 mm by 8 mm along its middle and a notch of the same size in its right wall. Faces
// between the boxes lie inside, where nothing comes to.
TriangleMesh bar() {
    return shapes::joined({shapes::box({-35, 0, 0}, {35, length, 6}), shapes::box({-35, 0, 6}, {27, length, 14}),
                           shapes::box({-35, 0, 14}, {-4, length, tall}), shapes::box({4, 0, 14}, {35, length, tall})});
}

struct Bar {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    TriangleMesh target = bar();
    ReplayScene scene;
    StockModel stock_model{
        {{-65, -30, -10}, {65, length + 30, tall + 5}}, {{0, 0, 1}, {std::sin(1.0), 0, std::cos(1.0)}}, 0.25};

    // The top and all sides are milled with the flat tool, from above.
    Bar() {
        scene.cell = &cell;
        scene.orientations = {{{0, 0, 1}, 0, {}}, {{std::sin(1.0), 0, std::cos(1.0)}, 0, {}}};
        scene.chunks = {{"qc_1_001", flat_20, 0}, {"qc_1_002", ball_12, 0}};
        scene.block = stock_model.block();
        scene.target = &target;
        for (std::size_t t = 0; t < target.triangles.size(); ++t) {
            scene.is_unmilled.push_back(area_vector(target, static_cast<std::uint32_t>(t)).z < 0 &&
                                        corners_of(target, static_cast<std::uint32_t>(t))[0].z == 0);
        }
        const Cutter flat = cutter_of(cell.machine->tools[1]);
        for (double y = -20; y < length + 20; y += 8) stock_model.cut(0, flat, 100, {-60, y, tall}, {60, y, tall});
        for (const double aside : {10.0, 25.0}) {
            const double x = 35 + aside;
            for (const double side : {-x, x}) stock_model.cut(0, flat, 100, {side, -25, -2}, {side, length + 25, -2});
            for (const double y : {-aside, length + aside}) stock_model.cut(0, flat, 100, {-60, y, -2}, {60, y, -2});
        }
    }
    void mill_groove() {
        const Cutter ball = cutter_of(cell.machine->tools[3]);
        for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            stock_model.cut(0, ball, 100, {x, -10, groove_floor}, {x, length + 10, groove_floor});
        }
    }
    LeftoverFigures measured() const {
        return measure_leftover(stock_model, scene, std::vector<float>(target.triangles.size(), 0), {}, {});
    }
    // Of the groove what a ball of 6 mm comes to within 0.4375 mm, all but 1.32 mm from its corners, less the upper
    // 0.75 mm of its walls, where the foam is within tolerance; the ball of 12 mm comes to the upper 0.57 mm.
    double groove_mm2() const { return length * (8 - 2 * 1.32 + 2 * (tall - groove_floor - 1.32 - 0.75)); }
    // Of the floor of the notch, 8 mm below its lip, what the tilted ball comes to within 0.4375 mm. Its centre, 3 mm
    // above the floor and 3 mm beside the ray through the lip, comes 2.24 mm under it, so that the back wall is never
    // touched. At the open sides the foam of the outer 0.75 mm is within tolerance.
    static double notch_mm2() {
        const double under = (8 - 3 - 3 / std::sin(1.0)) * std::tan(1.0);
        const double beside = std::sqrt(3.4375 * 3.4375 - 9);
        return (length - 2 * 0.75) * (under + beside - 0.75);
    }
};

TEST(GivenUp, IsWhatTheFinestToolOfTheCellReachesAndTheProgramDoesNotUse) {
    Bar bar;
    bar.scene.drilling = 1;  // the tilted direction is of holes alone
    const LeftoverFigures left = bar.measured();
    ASSERT_EQ(left.given_up.size(), 1U);
    EXPECT_EQ(left.given_up[0].tool, ball_6);
    EXPECT_EQ(left.given_up[0].orientation, 0U);
    EXPECT_NEAR(left.given_up_mm2(), bar.groove_mm2(), 0.2 * bar.groove_mm2());
    EXPECT_NEAR(left.within_mm2, left.reachable_mm2 - left.given_up_mm2(), 0.005 * left.area_mm2);
    EXPECT_TRUE(left.not_allowed.empty());
    double marked_mm2 = 0;
    for (std::size_t t = 0; t < left.is_given_up.size(); ++t) {
        if (left.is_given_up[t]) marked_mm2 += norm(area_vector(bar.target, t));
    }
    EXPECT_GE(marked_mm2, left.given_up_mm2()) << "whole triangles";
}

TEST(GivenUp, IsNothingWhereTheToolIsUsedOrTheSurfaceIsMilled) {
    Bar used;
    used.scene.drilling = 1;
    used.scene.chunks.push_back({"qc_1_003", ball_6, 0});
    const LeftoverFigures kept = used.measured();
    EXPECT_TRUE(kept.given_up.empty());
    EXPECT_LT(kept.within_mm2, kept.reachable_mm2 - 0.8 * used.groove_mm2()) << "its foam speaks against the program";
    Bar milled;
    milled.scene.drilling = 1;
    milled.mill_groove();
    const LeftoverFigures clear = milled.measured();
    EXPECT_LT(clear.given_up_mm2(), 0.01 * milled.groove_mm2());
    EXPECT_EQ(clear.reachable_mm2, kept.reachable_mm2) << "what is reachable does not depend on the program";
}

TEST(GivenUp, ByOrderOfTheOperatorIsToldApart) {
    Bar bar;
    bar.scene.drilling = 1;
    const LeftoverFigures all = bar.measured();
    bar.scene.tools = {1, flat_20, ball_12};
    const LeftoverFigures left = bar.measured();
    EXPECT_TRUE(left.given_up.empty());
    ASSERT_EQ(left.not_allowed.size(), 1U);
    EXPECT_EQ(left.not_allowed[0].tool, ball_6);
    EXPECT_NEAR(left.not_allowed_mm2(), all.given_up_mm2(), 1e-3 * all.given_up_mm2());
    EXPECT_NEAR(left.reachable_mm2 + left.not_allowed_mm2(), all.reachable_mm2, 0.01 * all.reachable_mm2);
}

TEST(GivenUp, ADirectionOfTheSetupThatTheProgramDoesNotTake) {
    Bar bar;
    bar.mill_groove();
    const LeftoverFigures left = bar.measured();
    ASSERT_FALSE(left.given_up.empty());
    EXPECT_EQ(left.given_up[0].orientation, 1U) << "the notch";
    EXPECT_NEAR(left.given_up_mm2(), bar.notch_mm2(), 0.25 * bar.notch_mm2());
    bar.scene.chunks.push_back({"qc_1_003", ball_6, 1});
    EXPECT_LT(bar.measured().given_up_mm2(), 0.01 * left.given_up_mm2());
}

// Balls on a plate beside a wall, against all closings of all ball-ended tools.
void expect_few_are_enough(double wall, std::size_t expected) {
    const Cell cell =
        with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml"));
    std::vector<TriangleMesh> meshes{shapes::box({0, 0, 0}, {60, 60, 5}), shapes::box({-12, 0, 0}, {0, 60, wall})};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(5, 55);
    for (int i = 0; i < 12; ++i) meshes.push_back(shapes::ball({at(random), at(random), 6}, 7, 10));
    const TriangleMesh mesh = shapes::joined(meshes);
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations = {{{0, 0, 1}, 0, {}}};
    scene.target = &mesh;
    Closings known(scene, {0.5});
    const std::vector<const Closing*> few = known.along(0, allowed_tools(scene), {});
    EXPECT_EQ(few.size(), expected);
    std::vector<SurfaceMap> all;
    for (const std::size_t tool : {0, 2, 3}) all.push_back(closing_of(scene, 0, cell.machine->tools[tool], {0.5}, {}));
    for (double x = 0.25; x < 60; x += 0.5) {
        for (double y = 0.25; y < 60; y += 0.5) {
            double lowest_of_few = 1e9;
            double lowest_of_all = 1e9;
            const Vec3 q = apply_inverse(all[0].frame_in_setup, Vec3{x, y, 0});
            for (const Closing* closing : few) lowest_of_few = std::min(lowest_of_few, closing->map.at(q.x, q.y));
            for (const SurfaceMap& map : all) lowest_of_all = std::min(lowest_of_all, map.at(q.x, q.y));
            ASSERT_NEAR(lowest_of_few, lowest_of_all, 0.25) << x << " " << y;  // half a cell
        }
    }
}

// Points all over a plate with balls beside a high wall: each is asked of the closings one after the other.
TEST(FirstReach, IsTheFirstClosingThatComesToAPoint) {
    const Cell cell =
        with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml"));
    std::vector<TriangleMesh> meshes{shapes::box({0, 0, 0}, {60, 60, 5}), shapes::box({-12, 0, 0}, {0, 60, 190})};
    for (const double x : {12.0, 35.0, 50.0}) meshes.push_back(shapes::ball({x, x, 6}, 7, 10));
    const TriangleMesh mesh = shapes::joined(meshes);
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations = {{{0, 0, 1}, 0, {}}, {normalized(Vec3{0.5, 0.2, 1}), 0, {}}};
    scene.target = &mesh;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> beside(-12, 60);
    std::vector<Vec3> points;
    for (int i = 0; i < 3000; ++i) points.push_back({beside(random), beside(random), 0.2 * (beside(random) + 12)});
    constexpr double cell_size = 0.5;
    constexpr double within = 0.6;
    const auto tools = [&](std::size_t) { return allowed_tools(scene); };
    const std::vector<std::optional<ReachingTool>> reach = first_reach(scene, points, tools, cell_size, within, {});
    Closings known(scene, {cell_size});
    std::vector<const Closing*> closings = known.along(0, allowed_tools(scene), {});
    for (const Closing* closing : known.along(1, allowed_tools(scene), {})) closings.push_back(closing);
    std::map<std::pair<std::size_t, std::size_t>, int> count;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto first = std::find_if(closings.begin(), closings.end(), [&](const Closing* closing) {
            const Vec3 q = apply_inverse(closing->map.frame_in_setup, points[i]);
            return closing->map.distance_above(q, within + 1) <= within;
        });
        ASSERT_EQ(reach[i].has_value(), first != closings.end()) << i;
        if (!reach[i]) continue;
        ASSERT_EQ(reach[i]->tool, (*first)->tool) << i;
        ASSERT_EQ(reach[i]->orientation, (*first)->orientation) << i;
        ++count[{reach[i]->orientation, reach[i]->tool}];
    }
    EXPECT_GE(count.size(), 4U) << "several tools along both directions are the first for some points";
}

// A holder meets a wall also where nothing is asked about the wall.
TEST(FirstReach, OfAPointAloneIsThatOfThePointAmongAll) {
    const Cell cell =
        with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml"));
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {200, 60, 5}), shapes::box({-12, 0, 0}, {0, 60, 400})});
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations = {{{0, 0, 1}, 0, {}}};
    scene.target = &mesh;
    std::vector<Vec3> points;
    for (double x = 2; x < 200; x += 6) points.push_back({x, 30, 5});
    const auto tools = [&](std::size_t) { return allowed_tools(scene); };
    const auto among_all = first_reach(scene, points, tools, 0.5, 0.6, {});
    std::size_t reached = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto alone = first_reach(scene, {points[i]}, tools, 0.5, 0.6, {}).front();
        EXPECT_EQ(alone.has_value(), among_all[i].has_value()) << points[i].x;
        reached += alone ? 1 : 0;
    }
    EXPECT_GT(reached, 0U);
    EXPECT_LT(reached, points.size());
}

TEST(Closings, TheFinestIsEnoughWhereItsHolderIsClear) {
    expect_few_are_enough(60, 1);
}

TEST(Closings, LongerToolsCountBesideAWallThatStopsTheHolderOfTheFinest) {
    expect_few_are_enough(130, 2);
    expect_few_are_enough(190, 3);
}

// Two bars on edge, with a valley of 45 degrees between them: a flat end of 20 mm stops 10 mm above its bottom, a bull
// of 24 mm on an edge of 11 mm comes lower.
TEST(Closings, ABullGoesDeeperIntoAValleyThanAFinerFlatEnd) {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    CuttingTool bull = cell.machine->tools[1];
    bull.number = 9;
    bull.shape = ToolShape::bull;
    bull.diameter = 24;
    bull.corner_radius = 11;
    CuttingTool wide = cell.machine->tools[1];
    wide.number = 10;
    wide.diameter = 30;
    cell.machine->tools = {cell.machine->tools[1], bull, wide};
    const double ridge = 30 * std::sqrt(2.0);
    const TriangleMesh bar = shapes::rotated(shapes::box({-30, 0, -30}, {30, 60, 30}), {0, 1, 0}, std::numbers::pi / 4);
    const TriangleMesh mesh =
        shapes::joined({shapes::moved(bar, {-ridge, 0, ridge}), shapes::moved(bar, {ridge, 0, ridge})});
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations = {{{0, 0, 1}, 0, {}}};
    scene.target = &mesh;
    Closings known(scene, {0.5});
    const std::vector<const Closing*> few = known.along(0, allowed_tools(scene), {});
    ASSERT_EQ(few.size(), 2U) << "the wider flat end adds nothing";
    const auto height_of = [&](const SurfaceMap& map) {
        const Vec3 q = apply_inverse(map.frame_in_setup, Vec3{0, 30, 0});
        return apply(map.frame_in_setup, Vec3{q.x, q.y, map.at(q.x, q.y)}).z - ridge;
    };
    EXPECT_NEAR(height_of(few[0]->map), 10, 0.5);
    EXPECT_NEAR(height_of(few[1]->map), 1 + 11 / std::sin(std::numbers::pi / 4) - 11, 0.5);
    EXPECT_NEAR(height_of(closing_of(scene, 0, wide, {0.5}, {})), 15, 0.5);
}

// A wall of 130 mm, beside which the holder of a ball of 6 mm, 20 mm wide and 100 mm above the tip, stops 30 mm high.
TEST(Closings, ClearanceOfTheHolderIsKeptBesideAndBelowIt) {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    const CuttingTool ball = cell.machine->tools[3];
    const TriangleMesh wall = shapes::box({-50, -50, 0}, {0, 50, 130});
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations = {{{0, 0, 1}, 0, {}}};
    scene.target = &wall;
    const auto height_at = [](const SurfaceMap& map, double x) {
        const Vec3 q = apply_inverse(map.frame_in_setup, Vec3{x, 0, 0});
        return apply(map.frame_in_setup, Vec3{q.x, q.y, map.at(q.x, q.y)}).z;
    };
    const SurfaceMap touching = closing_of(scene, 0, ball, {0.5, 30}, {});
    EXPECT_NEAR(height_at(touching, 5), 30, 0.5);
    EXPECT_LT(height_at(touching, 10.5), 2) << "the ball comes 3 mm nearer than its holder";
    const SurfaceMap clear = closing_of(scene, 0, ball, {0.5, 30, 6}, {});
    EXPECT_NEAR(height_at(clear, 5), 36, 0.5);
    EXPECT_NEAR(height_at(clear, 10.5), 36, 0.5);
    EXPECT_LT(height_at(clear, 17), 2);
}

// A block of which all is milled but its rim, which begins 20 mm beside the bar.
struct RimmedBar : Bar {
    StockModel rimmed{stock_model.block(), {{0, 0, 1}, {std::sin(1.0), 0, std::cos(1.0)}}, 0.25};

    RimmedBar() {
        const Cutter flat = cutter_of(cell.machine->tools[1]);
        for (double y = -20; y < length + 20; y += 8) rimmed.cut(0, flat, 100, {-60, y, tall}, {60, y, tall});
        for (const double x : {-45.0, 45.0}) rimmed.cut(0, flat, 100, {x, -25, -2}, {x, length + 25, -2});
        for (const double y : {-10.0, length + 10}) rimmed.cut(0, flat, 100, {-45, y, -2}, {45, y, -2});
        scene.block = rimmed.block();
    }
    VolumeFigures measured(const VolumeOptions& options) const { return measure_volumes(rimmed, scene, options, {}); }
};

// The groove is none of it: the tools of the program do not come there.
TEST(StandingFoam, IsAWallBesideThePieceAndNotTheGrooveThatNoToolOfTheProgramEnters) {
    Bar bar;
    VolumeOptions options;
    options.around = 24;
    EXPECT_LT(measure_volumes(bar.stock_model, bar.scene, options, {}).standing_mm3, 100);
    const VolumeFigures left = RimmedBar().measured(options);
    EXPECT_GT(left.standing_mm3, 1000);
    const Vec3 at = left.standing_at;
    EXPECT_GT(std::max({std::abs(at.x) - 35, -at.y, at.y - length}), 20 - 0.5);
    EXPECT_GE(at.z, options.floor);
    EXPECT_LE(at.z, tall);
}

TEST(StandingFoam, StepsOnTheFloorAreLeftWhereOnlyTiltedToolsCome) {
    RimmedBar bar;
    bar.scene.chunks = {{"qc_1_001", ball_12, 1}};
    VolumeOptions options;
    options.around = 24;
    const VolumeFigures left = bar.measured(options);
    EXPECT_GT(left.standing_mm3, 1000);
    EXPECT_GE(left.standing_at.z, options.oblique_floor);
    options.oblique_floor = options.floor;
    EXPECT_GT(bar.measured(options).standing_mm3, 1.5 * left.standing_mm3);
}

// The rim is 20 mm beside a bar that is 3 mm higher than the tools are long; their holder is 48 mm wide.
TEST(StandingFoam, StepsOnTheFloorAreLeftWhereAnUprightHolderComesNarrowly) {
    RimmedBar bar;
    for (CuttingTool& tool : bar.cell.machine->tools) tool.stick_out = tall - 3, tool.holder = {{48, 50}};
    VolumeOptions options;
    options.around = 24;
    options.floor_clearance = 2;
    const VolumeFigures touching = bar.measured(options);
    options.floor_clearance = 6;
    const VolumeFigures clear = bar.measured(options);
    EXPECT_LT(clear.standing_mm3, touching.standing_mm3 - 100);
    EXPECT_GT(clear.standing_mm3, 0);
}

TEST(Closings, WhereNothingIsInTheWayOfTheFinestToolItsOwnIsEnough) {
    Bar bar;
    Closings known(bar.scene, {0.5});
    const auto all = known.along(0, allowed_tools(bar.scene), {});
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(bar.cell.machine->tools[all[0]->tool].number, ball_6);
    const auto flat = known.along(0, {1}, {});
    ASSERT_EQ(flat.size(), 1U);
    EXPECT_EQ(bar.cell.machine->tools[flat[0]->tool].number, flat_20) << "where no other is named";
}

}  // namespace
}  // namespace qchopper
