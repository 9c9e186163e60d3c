// What a tool reaches by height fields: solids whose areas and volumes are known, what must hold of every piece, and
// rays and holders in a plain loop.

#include "cam/setup/mapped_access.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/cam/setup/access_case.h"
#include "tests/cam/setup/ray_areas.h"
#include "tests/cam/setup/solids.h"
#include "tests/reference/cam/setup/remaining_volume.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::AccessCase;
using test_pieces::cell_solid;
using test_pieces::steps;

constexpr double pi = std::numbers::pi;

// Tilted from up (z) towards x, then turned about z.
Vec3 tilted(double tilt_deg, double azimuth_deg = 0) {
    const double t = tilt_deg * pi / 180;
    const double a = azimuth_deg * pi / 180;
    return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

// Straight up alone, in a block with 10 mm of foam around and under the piece, which stands on its cap 0 at its own
// z = 0.
AccessCase standing(const TriangleMesh& mesh) {
    AccessCase setup;
    setup.mesh = &mesh;
    setup.base = 0;
    setup.up = {0, 0, 1};
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = {0, 0, -box.min.z};
    setup.block = {box.min - Vec3{10, 10, box.min.z + 10}, box.max + Vec3{10, 10, 10 - box.min.z}};
    setup.directions = {setup.up};
    return setup;
}

MappedAccess reach_of(const AccessCase& setup, double cell = 0.5, std::size_t stock_points = 1U << 18U) {
    return test_pieces::mapped_access(setup, {cell, stock_points});
}

TEST(MappedAccess, ABoxIsReachedFromAboveButForItsSteepWalls) {
    const TriangleMesh mesh =
        cell_solid(steps(0, 100, 10), steps(0, 80, 10), steps(0, 60, 10), [](Vec3) { return true; });
    AccessCase setup = standing(mesh);
    const MappedAccess from_above = reach_of(setup);
    const SurfaceAccess& access = from_above.access;
    const double walls = 2 * 60 * (100 + 80);
    EXPECT_EQ(access.method, AccessMethod::mapped);
    EXPECT_NEAR(access.area_mm2, 100 * 80 + walls, 1e-6);
    EXPECT_NEAR(access.steep_mm2, walls, 1e-6);
    EXPECT_EQ(access.hidden_mm2, 0);
    EXPECT_EQ(access.holder_mm2, 0);
    EXPECT_NEAR(access.unreachable_share(), walls / access.area_mm2, 1e-9);
    ASSERT_EQ(access.orientations.size(), 1U);
    EXPECT_NEAR(access.orientations[0].gained_share, 8000 / access.area_mm2, 1e-9);
    EXPECT_EQ(access.orientations[0].tilt_deg, 0);
    EXPECT_NEAR(access.orientations[0].depth_mm, 10, 0.06) << "the foam over the top";
    EXPECT_LE(access.foam_mm3, 0.25 * walls);
    EXPECT_EQ(access.foam_depth_mm, 0);
    setup.steep_counts = false;
    const SurfaceAccess by_side = reach_of(setup).access;
    EXPECT_EQ(by_side.unreachable_share(), 0);
    EXPECT_NEAR(by_side.steep_mm2, walls, 1e-6) << "reported all the same";
    EXPECT_GT(by_side.orientations[0].depth_mm, 60) << "the side of the tool goes down the walls";
    setup.steep_counts = true;
    for (const double azimuth : {0, 90, 180, 270}) setup.directions.push_back(tilted(60, azimuth));
    EXPECT_LT(reach_of(setup).access.unreachable_share(), 1e-9);
}

TEST(MappedAccess, WhatIsIgnoredCountsNowhere) {
    TriangleMesh mesh = cell_solid(steps(0, 100, 10), steps(0, 80, 10), steps(0, 60, 10), [](Vec3) { return true; });
    const MappedAccess all = reach_of(standing(mesh));
    mesh.ignored.assign(mesh.triangles.size(), 0);
    EXPECT_EQ(reach_of(standing(mesh)).access, all.access);
    // The walls across x, and the base, which is no surface anyway.
    const auto is_across_x = [&](std::size_t t) { return std::abs(normalized(area_vector(mesh, t)).x) > 0.5; };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        mesh.ignored[t] = is_across_x(t) || cap_of(mesh, t) != no_cap ? 1 : 0;
    }
    const MappedAccess some = reach_of(standing(mesh));
    EXPECT_NEAR(some.access.ignored_mm2, 2 * 60 * 80, 1e-6);
    EXPECT_NEAR(some.access.area_mm2, all.access.area_mm2 - 2 * 60 * 80, 1e-6);
    EXPECT_NEAR(some.access.steep_mm2, 2 * 60 * 100, 1e-6);
    EXPECT_NEAR(some.access.orientations[0].gained_share, 8000 / some.access.area_mm2, 1e-9);
    EXPECT_EQ(some.access.foam_mm3, all.access.foam_mm3) << "foam stays all the same";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_EQ(some.states[t] == SurfaceState::ignored, is_across_x(t)) << t;
    }
}

TEST(MappedAccess, TrianglesWithoutAreaChangeNothing) {
    TriangleMesh mesh =
        cell_solid({0, 30, 90}, {0, 35, 70}, {0, 10, 50, 65}, [](Vec3 p) { return p.z < 10 || p.x < 30 || p.z > 50; });
    const MappedAccess before = reach_of(standing(mesh));
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({0, 1, 0});
    mesh.cap_of.insert(mesh.cap_of.end(), 2, no_cap);
    EXPECT_EQ(reach_of(standing(mesh)).access, before.access);
}

// Share of a horizontal slot's floor: carve, invariants.
TEST(MappedAccess, ASlotIsReachedAsFarAsTheTiltLooksIn) {
    constexpr double deep = 30;
    constexpr double high = 10;
    const TriangleMesh mesh = cell_solid(steps(0, 60, 1), {0, 25, 50}, {0, 20, 20 + high, 50},
                                         [](Vec3 p) { return p.x < 60 - deep || p.z < 20 || p.z > 20 + high; });
    for (const double tilt : {20.0, 45.0, 60.0, 80.0}) {
        AccessCase setup = standing(mesh);
        setup.directions.push_back(tilted(tilt));
        const MappedAccess found = reach_of(setup, 0.25);
        double open = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 n = area_vector(mesh, t);
            const Vec3 middle = mesh.points[mesh.triangles[t][0]];
            if (n.z > 0 && middle.z == 20 && found.states[t] == SurfaceState::reached) open += n.z;
        }
        const double expected = std::min(1.0, high / deep * std::tan(tilt * pi / 180));
        EXPECT_NEAR(open / (deep * 50), expected, 0.04) << tilt;
        const double floor_mm2 = deep * 50;
        const Vec3 d = tilted(tilt);
        // The wall at its end and the floor; what is hidden besides is the slot's ceiling.
        EXPECT_GT(found.access.hidden_mm2, floor_mm2 * (2 - expected) - 60) << d.x;
        EXPECT_GT(found.access.foam_depth_mm, 0);
    }
}

// A square shaft from the top of a block, 40 mm wide and 110 mm deep.
TriangleMesh shaft() {
    return cell_solid({0, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48, 50, 52, 54, 56, 58, 60, 62, 64, 66, 68, 70, 100},
                      {0, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48, 50, 52, 54, 56, 58, 60, 62, 64, 66, 68, 70, 100},
                      {0, 10, 120},
                      [](Vec3 p) { return p.z < 10 || std::abs(p.x - 50) > 20 || std::abs(p.y - 50) > 20; });
}

TEST(MappedAccess, AHolderKeepsAShortToolOutOfADeepShaft) {
    const TriangleMesh mesh = shaft();
    AccessCase setup = standing(mesh);
    const SurfaceAccess without = reach_of(setup).access;
    EXPECT_EQ(without.holder_mm2, 0);
    EXPECT_NEAR(without.orientations[0].depth_mm, 120, 0.06);
    const double floor = 40 * 40;
    setup.tool = ToolBody{80, {{60, 50}}};
    const MappedAccess wide = reach_of(setup);
    EXPECT_NEAR(wide.access.holder_mm2, floor, 1e-6);
    EXPECT_NEAR(wide.access.orientations[0].gained_share,
                without.orientations[0].gained_share - floor / without.area_mm2, 1e-9);
    EXPECT_NEAR(wide.access.orientations[0].depth_mm, 10, 0.06);
    setup.tool = ToolBody{111, {{60, 50}}};
    EXPECT_EQ(reach_of(setup).access.holder_mm2, 0) << "longer than the shaft is deep";
    // Narrower than the shaft: the middle of the floor, 10 mm wide, leaves room on all sides; cells are 1 mm there.
    setup.tool = ToolBody{80, {{30, 50}}};
    const double narrow = reach_of(setup).access.holder_mm2;
    EXPECT_GT(narrow, floor - 13 * 13);
    EXPECT_LT(narrow, floor - 7 * 7);
    // A second step above: the first goes in, the second does not.
    setup.tool = ToolBody{80, {{20, 20}, {60, 50}}};
    EXPECT_NEAR(reach_of(setup).access.holder_mm2, floor, 1e-6);
    setup.tool = ToolBody{80, {{4, 31}, {60, 50}}};
    EXPECT_LT(reach_of(setup).access.holder_mm2, 0.35 * floor);
}

// 30.5 / (61 / 22) is 11 by rounding, but 11 cells of that width are more than the radius.
TEST(MappedAccess, AHolderAsWideAsAWholeNumberOfCellsIsNoWider) {
    const TriangleMesh mesh = shaft();
    AccessCase setup = standing(mesh);
    setup.tool = ToolBody{80, {{61, 50}}};
    EXPECT_NEAR(reach_of(setup, 61.0 / 44).access.holder_mm2, 40 * 40, 0.05 * 40 * 40) << "cells at its outline";
}

// A tool that lies flat: its holder would dip into the spoil layer.
TEST(MappedAccess, AHolderMayNotComeBelowTheSpoilLayersTop) {
    const TriangleMesh mesh = cell_solid(steps(0, 40, 20), steps(0, 40, 1), steps(0, 60, 1), [](Vec3) { return true; });
    AccessCase setup = standing(mesh);
    setup.directions.push_back({1, 0, 0});
    EXPECT_EQ(reach_of(setup).access.holder_mm2, 0);
    setup.tool = ToolBody{50, {{40, 30}}};
    EXPECT_NEAR(reach_of(setup).access.holder_mm2, 20 * 40, 40.001) << "a row of triangles more or less";
    // Leaning by 60 degrees the holder's lowest point is 50 cos 60 - 20 sin 60 = 7.7 mm above the tip, so all is
    // reached; with 20 mm of stick-out it is 7.3 mm below.
    setup.directions.back() = tilted(60);
    EXPECT_EQ(reach_of(setup).access.holder_mm2, 0);
    setup.tool = ToolBody{20, {{40, 30}}};
    const double below = 20 * std::sin(pi / 3) - 20 * 0.5;
    EXPECT_NEAR(reach_of(setup).access.holder_mm2, below * 40, 40.001);
}

TEST(MappedAccess, FoamUnderAShelfHasItsVolume) {
    const TriangleMesh mesh =
        cell_solid({0, 30, 90}, {0, 35, 70}, {0, 10, 50, 65}, [](Vec3 p) { return p.z < 10 || p.x < 30 || p.z > 50; });
    AccessCase setup = standing(mesh);
    const SurfaceAccess from_above = reach_of(setup, 0.5, 1U << 20U).access;
    const double under = 60 * 70 * 40;
    EXPECT_NEAR(from_above.foam_mm3, under, 0.01 * under);
    EXPECT_NEAR(from_above.foam_depth_mm, 65 - 10 - 0.5, 0.04) << "the shelf is counted with it";
    EXPECT_NEAR(from_above.hidden_mm2, 2 * 60 * 70, 1e-6) << "the floor and the shelf's underside";
    // A horizontal tool takes all of it out, one of 45 degrees what lies above its lowest line of sight.
    setup.directions = {{0, 0, 1}, {1, 0, 0}};
    EXPECT_LT(reach_of(setup, 0.5, 1U << 20U).access.foam_mm3, 0.01 * under);
    setup.directions = {{0, 0, 1}, tilted(45)};
    const double seen = 0.5 * 40 * 40;
    EXPECT_NEAR(reach_of(setup, 0.5, 1U << 20U).access.foam_mm3, under - seen * 70, 0.01 * under);
}

// The points of the foam against the grid of remaining_volume().
TEST(MappedAccess, FoamIsWhatRemainsBesideThePiece) {
    const TriangleMesh mesh = sample(Specimen::vertebra, {.faces = 20'000});
    AccessCase setup = standing(mesh);
    setup.base.reset();
    setup.directions = {{0, 0, 1}, tilted(50), tilted(50, 120)};
    const double cell = 0.5;
    std::vector<HeightField> maps;
    const Pose setup_in_piece = inverse(setup.piece_in_setup);
    Pose box_in_piece = setup_in_piece;
    box_in_piece.shift = apply(setup_in_piece, {setup.block.min.x, setup.block.min.y, 0});
    const Vec3 size = setup.block.max - Vec3{setup.block.min.x, setup.block.min.y, 0};
    for (const Vec3& d : setup.directions) {
        maps.push_back(height_field(mesh, d, cell));
        AccessCase some = setup;
        some.directions.resize(maps.size());
        const double foam = reach_of(some, cell, 1U << 21U).access.foam_mm3;
        const double remaining = remaining_volume(maps, size, box_in_piece, 2) - volume_mm3(mesh);
        EXPECT_NEAR(foam, remaining, 0.01 * volume_mm3(mesh)) << maps.size();
        EXPECT_GT(foam, 0);
    }
}

TEST(MappedAccess, RestMaterialOfACornerIsThatOfTheBall) {
    // A floor with a wall along one side.
    const TriangleMesh mesh =
        cell_solid({0, 30, 100}, {0, 75, 150}, {0, 20, 60}, [](Vec3 p) { return p.z < 20 || p.x < 30; });
    for (const double radius : {3.0, 8.0, 15.0}) {
        AccessCase setup = standing(mesh);
        setup.smallest_ball_radius = radius;
        const double expected = (1 - pi / 4) * radius * radius * 150;
        EXPECT_NEAR(reach_of(setup, 0.25, 1U << 22U).access.rest_material_mm3, expected, 0.15 * expected) << radius;
    }
    AccessCase setup = standing(mesh);
    EXPECT_EQ(reach_of(setup).access.rest_material_mm3, 0) << "of no ball";
}

const TriangleMesh& bone() {
    static const TriangleMesh mesh = sample(Specimen::vertebra, {.faces = 40'000});
    return mesh;
}

AccessCase lying(const TriangleMesh& mesh) {
    AccessCase setup = standing(mesh);
    setup.base.reset();
    return setup;
}

TEST(MappedAccess, TurningEverythingTogetherChangesNothing) {
    AccessCase setup = lying(bone());
    setup.directions = {{0, 0, 1}, tilted(40, 20), tilted(60, 200)};
    setup.tool = ToolBody{60, {{40, 50}, {180, 350}}};
    setup.smallest_ball_radius = 5;
    const SurfaceAccess before = reach_of(setup, 0.4, 1U << 20U).access;
    const Vec3 axis = normalized({0.3, -0.7, 0.5});
    const TriangleMesh turned = shapes::moved(shapes::rotated(bone(), axis, 1.1), {500, -200, 80});
    TriangleMesh frame;
    frame.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    frame.points.insert(frame.points.end(), setup.directions.begin(), setup.directions.end());
    const TriangleMesh turned_frame = shapes::rotated(frame, axis, 1.1);
    const Pose turn_back{{turned_frame.points[0], turned_frame.points[1], turned_frame.points[2]}, {}};
    AccessCase same = setup;
    same.mesh = &turned;
    same.directions.assign(turned_frame.points.begin() + 3, turned_frame.points.end());
    same.up = same.directions.front();
    same.piece_in_setup = setup.piece_in_setup * turn_back * Pose{Pose{}.row, {-500, 200, -80}};
    const SurfaceAccess after = reach_of(same, 0.4, 1U << 20U).access;
    EXPECT_NEAR(after.hidden_mm2, before.hidden_mm2, 0.003 * before.area_mm2);
    EXPECT_NEAR(after.holder_mm2, before.holder_mm2, 0.003 * before.area_mm2);
    EXPECT_NEAR(after.steep_mm2, before.steep_mm2, 0.001 * before.area_mm2);
    EXPECT_NEAR(after.foam_mm3, before.foam_mm3, 0.03 * before.foam_mm3);
    EXPECT_NEAR(after.rest_material_mm3, before.rest_material_mm3, 0.05 * before.rest_material_mm3);
    EXPECT_NEAR(after.foam_depth_mm, before.foam_depth_mm, 5);
    EXPECT_GT(before.holder_mm2, 0);
    for (std::size_t i = 0; i < before.orientations.size(); ++i) {
        EXPECT_NEAR(after.orientations[i].gained_share, before.orientations[i].gained_share, 0.003);
        EXPECT_NEAR(after.orientations[i].tilt_deg, before.orientations[i].tilt_deg, 1e-6);
        EXPECT_NEAR(after.orientations[i].depth_mm, before.orientations[i].depth_mm, 5);
    }
}

TEST(MappedAccess, ALongerToolNeverReachesLess) {
    AccessCase setup = lying(bone());
    setup.directions = {{0, 0, 1}, tilted(60, 45)};
    double before = INFINITY;
    bool is_ever_short = false;
    for (const double stick_out : {10.0, 25.0, 50.0, 100.0, 200.0, 400.0}) {
        setup.tool = ToolBody{stick_out, {{40, 50}, {180, 350}}};
        const SurfaceAccess access = reach_of(setup, 0.5).access;
        EXPECT_LE(access.unreachable_mm2(), before + 1e-9);
        before = access.unreachable_mm2();
        is_ever_short = is_ever_short || access.holder_mm2 > 0.01 * access.area_mm2;
    }
    EXPECT_TRUE(is_ever_short);
    setup.tool.reset();
    EXPECT_LE(reach_of(setup, 0.5).access.unreachable_mm2(), before + 1e-9);
}

TEST(MappedAccess, AFurtherDirectionNeverMakesLessReached) {
    AccessCase setup = lying(bone());
    setup.tool = ToolBody{100, {{40, 50}, {180, 350}}};
    setup.smallest_ball_radius = 4;
    double unreachable = INFINITY;
    double foam = INFINITY;
    double gained = 0;
    for (int i = 0; i < 5; ++i) {
        if (i > 0) setup.directions.push_back(tilted(30 + 10 * i, 80 * i));
        const SurfaceAccess access = reach_of(setup, 0.5).access;
        EXPECT_LE(access.unreachable_mm2(), unreachable + 1e-6);
        EXPECT_LE(access.foam_mm3, foam);
        EXPECT_GE(access.rest_material_mm3, 0);
        unreachable = access.unreachable_mm2();
        foam = access.foam_mm3;
        gained += access.orientations.back().gained_share;
        EXPECT_NEAR(gained, 1 - access.unreachable_share(), 1e-6) << "the shares that directions gain add up";
    }
}

TEST(MappedAccess, IsTheSameOnAnyNumberOfThreads) {
    AccessCase setup = lying(bone());
    setup.directions = {{0, 0, 1}, tilted(50, 10)};
    setup.tool = ToolBody{50, {{40, 50}, {180, 350}}};
    setup.smallest_ball_radius = 4;
    const MappedAccess all = reach_of(setup, 0.7);
    const ThreadLimit one(1);
    const MappedAccess same = reach_of(setup, 0.7);
    EXPECT_EQ(all.access, same.access);
    EXPECT_EQ(all.states, same.states);
}

TEST(MappedAccess, ReachesTheAreaThatRaysReach) {
    for (const Specimen specimen : {Specimen::vertebra, Specimen::femur, Specimen::skull}) {
        const TriangleMesh mesh = sample(specimen, {.faces = 60'000});
        for (const Vec3 d : {Vec3{0, 0, 1}, tilted(35, 70), tilted(60, 190), tilted(90, 300)}) {
            EXPECT_GT(test_pieces::expect_rays_agree(mesh, d, 0), 0.1);
        }
    }
}

// Whether some vertex lies in a step of the tool, whose tip stands at a point: by a loop over all of them.
bool touches(const std::vector<Vec3>& vertices, Vec3 tip, Vec3 tool_axis, const ToolBody& tool) {
    return std::any_of(vertices.begin(), vertices.end(), [&](Vec3 vertex) {
        const Vec3 from = vertex - tip;
        const double along = dot(from, tool_axis);
        const double across = norm(from - along * tool_axis);
        double above = tool.stick_out;
        for (const HolderStep& step : tool.steps) {
            if (along > above && along < above + step.length && across < 0.5 * step.diameter) return true;
            above += step.length;
        }
        return false;
    });
}

TEST(MappedAccess, HolderAgreesWithALoopOverTheVertices) {
    const TriangleMesh& mesh = bone();
    for (const Vec3 d : {Vec3{0, 0, 1}, tilted(50, 100)}) {
        AccessCase setup = lying(mesh);
        // High above the table, so that only the piece is in the way.
        setup.piece_in_setup.shift.z += 5000;
        setup.block.max.z += 6000;
        setup.directions = {d};
        setup.up = d;
        const MappedAccess in_sight = reach_of(setup, 0.3);
        setup.tool = ToolBody{40, {{40, 50}, {180, 2000}}};
        const MappedAccess found = reach_of(setup, 0.3);
        double by_loop = 0;
        double by_map = 0;
        double all = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 7) {
            const double area = norm(area_vector(mesh, t));
            all += area;
            if (in_sight.states[t] != SurfaceState::reached) continue;
            const Triangle& v = mesh.triangles[t];
            const Vec3 middle = (1.0 / 3) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
            if (touches(mesh.points, middle, d, *setup.tool)) by_loop += area;
            if (found.states[t] == SurfaceState::holder) by_map += area;
        }
        EXPECT_GT(by_loop, 0.01 * all);
        EXPECT_NEAR(by_map / all, by_loop / all, 0.005) << "of the area";
    }
}

TEST(LongestTool, IsTheFirstOfThoseWithTheLargestStickOut) {
    std::vector<CuttingTool> tools(3);
    tools[0].stick_out = 100;
    tools[1].stick_out = 150;
    tools[2].stick_out = 150;
    EXPECT_EQ(&longest_tool(tools), &tools[1]);
}

TEST(ToolBody, HoldsTheHolderAndTheSpindle) {
    CuttingTool tool;
    tool.diameter = 6;
    tool.stick_out = 100;
    tool.holder = {{20, 50}, {32, 40}};
    CellMachine gantry;
    gantry.spindle.body_radius = 90;
    gantry.spindle.body_length = 350;
    const ToolBody body = tool_body(tool, gantry);
    EXPECT_EQ(body.stick_out, 100);
    EXPECT_EQ(body.steps, (std::vector<HolderStep>{{20, 50}, {32, 40}, {180, 350}}));
    gantry.spindle.body_offset = 15;
    EXPECT_EQ(tool_body(tool, gantry).steps, (std::vector<HolderStep>{{20, 50}, {32, 55}, {180, 350}}));
}

TEST(ToolBody, EndsInTheWristWhereThatIsAboutTheToolAxis) {
    const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells/kr60-ha.toml");
    const ToolBody body = tool_body(cell.machine->tools.front(), *cell.machine);
    ASSERT_EQ(body.steps.size(), 3U);
    EXPECT_EQ(body.steps[1].diameter, 180);
    EXPECT_EQ(body.steps[2].diameter, 2 * (120 + 10)) << "with the distance that the arm keeps";
    // The sphere of 130 about the flange, 550 above the tip, is as wide as the spindle 93.8 below it.
    EXPECT_NEAR(200 + body.steps[1].length, 550 - std::sqrt(130.0 * 130 - 90 * 90), 1e-9);
}

}  // namespace
}  // namespace qchopper
