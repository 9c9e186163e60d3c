// Sections and forces against closed forms, and against the loops that the cut makes.

#include "cam/setup/workholding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "cam/setup/choose_setup.h"
#include "cam/setup/standing_sections.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/plane_section.h"
#include "segment/raster/height_field.h"
#include "tests/cam/setup/pieces.h"
#include "tests/cam/setup/solids.h"

namespace qchopper {
namespace {

using namespace test_pieces;

constexpr double pi = std::numbers::pi;

Cell ready_cell(const char* name = "kr60-ha.toml") {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

// A mesh as it stands, its base plane at 0, in a block with 5 mm beside it.
qchopper::Setup standing(const TriangleMesh& mesh) {
    Setup setup;
    setup.box = bounds(mesh);
    setup.spoil = 10;
    setup.block.stock = 0;
    setup.block.size = setup.box.size() + Vec3{10, 10, 13};
    return setup;
}

Workholding check_of(const TriangleMesh& mesh, const Cell& cell) {
    const qchopper::Setup setup = standing(mesh);
    return check_workholding(standing_sections(mesh, setup), setup, cell);
}

// On few samples, without maps.
SetupOptions coarse() {
    SetupOptions options;
    options.samples = 100;
    options.mapped = 0;
    return options;
}

double rectangle_modulus(double x, double y) {
    return x * y / (6 * std::hypot(1 / x, 1 / y));
}

// A cone or a frustum of n sides about z, from radius r at z = 0 to radius q at z = h; r may be 0.
TriangleMesh frustum(double r, double q, double h, std::uint32_t n) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * pi * i / n;
        mesh.points.push_back({r * std::cos(a), r * std::sin(a), 0});
        mesh.points.push_back({q * std::cos(a), q * std::sin(a), h});
    }
    const auto bottom = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({0, 0, 0});
    mesh.points.push_back({0, 0, h});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i;
        const std::uint32_t b = 2 * ((i + 1) % n);
        if (r > 0) mesh.triangles.push_back({bottom, b, a});
        mesh.triangles.push_back({bottom + 1, a + 1, b + 1});
        if (r > 0) mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({r > 0 ? a : bottom, b + 1, a + 1});
    }
    return mesh;
}

TEST(StandingSections, OfAPrismAreItsRectangle) {
    const TriangleMesh mesh = shapes::box({-20, -30, 0}, {20, 30, 120}, 3);
    const std::vector<StandingSection> sections = standing_sections(mesh, standing(mesh));
    ASSERT_EQ(sections.size(), 13U);
    EXPECT_EQ(sections.front().z, 0);
    EXPECT_NEAR(sections.back().z, 40, 1e-12);
    for (const StandingSection& s : sections) {
        EXPECT_NEAR(s.area_mm2, 2400, 1e-9) << s.z;
        EXPECT_NEAR(s.modulus_mm3, rectangle_modulus(40, 60), 1e-8) << s.z;
        EXPECT_NEAR(s.width, 40, 1e-9) << s.z;
        EXPECT_NEAR(s.reach, std::hypot(20, 30), 1e-9) << s.z;
        EXPECT_NEAR(std::hypot(s.centroid.x, s.centroid.y), 0, 1e-12) << s.z;
    }
}

TEST(Workholding, OfAPrismIsTheFlexureFormula) {
    const TriangleMesh mesh = shapes::box({-20, -30, 0}, {20, 30, 120}, 3);
    const Cell cell = ready_cell();
    const Workholding check = check_of(mesh, cell);
    EXPECT_NEAR(check.foam_force, 0.6 * rectangle_modulus(40, 60) / 120, 1e-9);
    EXPECT_EQ(check.narrowest_z, 0);
    EXPECT_NEAR(check.narrowest_mm2, 2400, 1e-9);
    const double k = 1 + 5 / std::hypot(20, 30);  // 5 mm of foam beside it, less than the spoil layer
    EXPECT_NEAR(check.joint_force, 0.1 * k * k * k * rectangle_modulus(40, 60) / 130, 1e-9);
    EXPECT_EQ(check.height, 120);
    EXPECT_NEAR(check.base_width, 40, 1e-9);
    EXPECT_TRUE(check.is_stout());
}

// Of a low, wide piece in a high, narrow block the block on its underside is the worse state.
TEST(Workholding, AHighBlockIsHeldBeforeRoughingToo) {
    const TriangleMesh mesh = shapes::box({-100, -100, 0}, {100, 100, 30});
    qchopper::Setup setup = standing(mesh);
    setup.block.size = {210, 210, 900};
    const Workholding check = check_workholding(standing_sections(mesh, setup), setup, ready_cell());
    EXPECT_NEAR(check.joint_force, 0.1 * rectangle_modulus(210, 210) / 900, 1e-9);
}

TEST(Workholding, ADiscSpreadsThroughTheSpoilLayerByItsThickness) {
    const std::uint32_t n = 720;
    const TriangleMesh mesh = frustum(30, 40, 100, n);
    qchopper::Setup setup = standing(mesh);
    setup.block.size = {200, 200, 113};
    const Workholding check = check_workholding(standing_sections(mesh, setup), setup, ready_cell());
    EXPECT_NEAR(check.joint_force, 0.1 * pi * std::pow(40, 3) / 4 / 110, 2e-3);  // of 30 + 10 mm
    EXPECT_NEAR(check.foam_force, 0.6 * pi * std::pow(30, 3) / 4 / 100, 1e-2);
    EXPECT_EQ(check.narrowest_z, 0);
}

// Second moment of a regular polygon of n corners at a radius r: n r^4 sin a (2 + cos a) / 24, a = 2 pi / n.
TEST(StandingSections, OfAConeAreRegularPolygons) {
    const std::uint32_t n = 24;
    const double a = 2 * pi / n;
    const TriangleMesh mesh = frustum(0, 60, 240, n);
    const std::vector<StandingSection> sections = standing_sections(mesh, standing(mesh));
    EXPECT_EQ(sections.front().area_mm2, 0);
    for (std::size_t k = 1; k < sections.size(); ++k) {
        const double r = 60 * sections[k].z / 240;
        EXPECT_NEAR(sections[k].area_mm2, n * r * r * std::sin(a) / 2, 1e-9 * r * r);
        EXPECT_NEAR(sections[k].modulus_mm3, n * std::pow(r, 3) * std::sin(a) * (2 + std::cos(a)) / 24,
                    1e-9 * std::pow(r, 3));
        EXPECT_NEAR(sections[k].width, 2 * r * std::cos(a / 2), 1e-9 * r);
        EXPECT_NEAR(sections[k].reach, r, 1e-9 * r);
    }
}

TEST(Workholding, APieceOnItsTipIsTold) {
    const Workholding check = check_of(frustum(0, 70, 247, 24), ready_cell());
    EXPECT_EQ(check.joint_force, 0);
    EXPECT_EQ(check.foam_force, 0);
    EXPECT_EQ(check.narrowest_z, 0);
    EXPECT_FALSE(check.passes());
    const std::string problem = workholding_problem(check);
    EXPECT_NE(problem.find("0.1 N/mm2 parts at 0.0 N, less than the cutting force of 20 N"), std::string::npos);
    EXPECT_NE(problem.find("247 mm high on a base 0 mm wide"), std::string::npos) << problem;
    ASSERT_TRUE(check.stand);
    EXPECT_NE(workholding_remedy(check).find("a stand of uncut foam around its lowest " +
                                             std::to_string(std::lround(check.stand->top)) + " mm"),
              std::string::npos);
}

// The pieces that were told of as unsafe, as frusta: 214 mm on 4.6 cm2 and 353 mm on 30 cm2. A stout one passes.
TEST(Workholding, SlenderPiecesOnSmallBasesDoNotPass) {
    const auto on = [](double cm2, double height) {
        const double r = std::sqrt(100 * cm2 / pi);
        return check_of(frustum(r, 1.5 * r, height, 90), ready_cell());
    };
    EXPECT_FALSE(on(4.6, 214).foam_holds());
    EXPECT_FALSE(on(30, 353).joint_holds());
    EXPECT_FALSE(on(30, 353).is_stout());
    EXPECT_TRUE(on(60, 150).passes()) << workholding_problem(on(60, 150));
}

TEST(Workholding, AStandHoldsWhatStandsOnIt) {
    const Cell cell = ready_cell();
    const TriangleMesh mesh = frustum(4, 60, 200, 48);
    const Workholding check = check_of(mesh, cell);
    ASSERT_TRUE(check.stand);
    const double side = check.stand->side;
    EXPECT_GE(0.1 * rectangle_modulus(side, side) / 210, 20);
    EXPECT_GE(side, 200.0 / 4);
    for (const StandingSection& s : standing_sections(mesh, standing(mesh))) {
        if (s.z < check.stand->top) continue;
        EXPECT_GE(0.6 * s.modulus_mm3 / (200 - s.z), 20) << s.z;
    }
    EXPECT_NEAR(check.stand->x, 0, 1e-9);
    EXPECT_NEAR(check.stand->y, 0, 1e-9);
}

// A plate of 60 x 60 x 10, a stem of 20 x 20, a head from z = 80 to 120 that is 100 x 100 and whose rim hangs down
// to 5.
TriangleMesh bell() {
    const std::vector<double> across{-50, -45, -30, -10, 10, 30, 45, 50};
    return cell_solid(across, across, {0, 5, 10, 80, 120}, [](Vec3 p) {
        const double out = std::max(std::abs(p.x), std::abs(p.y));
        if (p.z > 80) return true;
        if (out > 45) return p.z > 5;
        return out < (p.z < 10 ? 30 : 10);
    });
}

TEST(Workholding, ANarrowStemCountsAndWhatHangsBesideItDoesNot) {
    const TriangleMesh mesh = bell();
    for (const StandingSection& s : standing_sections(mesh, standing(mesh))) {
        const double side = s.z <= 10 ? 60 : 20;
        EXPECT_NEAR(s.area_mm2, side * side, 1e-9) << s.z;
        EXPECT_NEAR(s.modulus_mm3, rectangle_modulus(side, side), 1e-8) << s.z;
    }
    const Workholding check = check_of(mesh, ready_cell());
    EXPECT_NEAR(check.narrowest_z, 40.0 / 3, 1e-9) << "the first section above the plate, with the longest lever";
    EXPECT_NEAR(check.foam_force, 0.6 * rectangle_modulus(20, 20) / (120 - 40.0 / 3), 1e-9);
    EXPECT_NEAR(check.base_mm2, 3600, 1e-9);
}

TEST(StandingSections, ACavityTakesMaterialAway) {
    TriangleMesh mesh = shapes::box({-30, -30, 0}, {30, 30, 60});
    const auto outer = static_cast<std::uint32_t>(mesh.points.size());
    const TriangleMesh hole = shapes::box({-20, -20, 4}, {20, 20, 50});
    mesh.points.insert(mesh.points.end(), hole.points.begin(), hole.points.end());
    for (const auto& [a, b, c] : hole.triangles) mesh.triangles.push_back({outer + a, outer + c, outer + b});
    for (const StandingSection& s : standing_sections(mesh, standing(mesh))) {
        EXPECT_NEAR(s.area_mm2, s.z <= 4 ? 3600 : 2000, 1e-9) << s.z;
        const double moment = (std::pow(60, 4) - (s.z <= 4 ? 0 : std::pow(40, 4))) / 12;
        EXPECT_NEAR(s.modulus_mm3, moment / std::hypot(30, 30), 1e-8) << s.z;
    }
}

// Against the loops of a cut: what stands is all of the section or the part of it that is joined below.
TEST(StandingSections, AreNoMoreThanTheSectionsOfTheCutAndMostlyAllOfThem) {
    int whole = 0;
    int all = 0;
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell(), coarse()).setups.front();
        for (const StandingSection& s : standing_sections(*piece.mesh, setup)) {
            if (s.z == 0) continue;
            const Vec3 up = setup.piece_in_setup.row[2];
            const Plane plane{up, s.z - setup.piece_in_setup.shift.z};
            const PlaneSection cut = plane_section(*piece.mesh, plane, points_above(*piece.mesh, plane));
            std::vector<Point2> flat;
            for (const Vec3& p : cut.points)
                flat.push_back({apply(setup.piece_in_setup, p).x, apply(setup.piece_in_setup, p).y});
            double area = 0;
            for (const Loop& loop : cut.loops) area += signed_area(flat, loop);
            EXPECT_LE(s.area_mm2, area + 1e-6 * (1 + area)) << piece.name << " at " << s.z;
            ++all;
            whole += s.area_mm2 > (1 - 1e-6) * area ? 1 : 0;
        }
    }
    EXPECT_GT(whole, 3 * all / 4) << all;
}

TEST(StandingSections, TurningAboutTheVerticalChangesNothing) {
    for (const Piece& piece : cut_shapes()) {
        qchopper::Setup setup = choose_setup(piece, cell(), coarse()).setups.front();
        const std::vector<StandingSection> before = standing_sections(*piece.mesh, setup);
        const double c = std::cos(0.7);
        const double s = std::sin(0.7);
        const Pose turn{{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, {}};
        setup.piece_in_setup = turn * setup.piece_in_setup;
        const std::vector<StandingSection> after = standing_sections(*piece.mesh, setup);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t k = 0; k < before.size(); ++k) {
            EXPECT_NEAR(after[k].area_mm2, before[k].area_mm2, 1e-9 * (1 + before[k].area_mm2)) << piece.name;
            EXPECT_NEAR(after[k].modulus_mm3, before[k].modulus_mm3, 1e-9 * (1 + before[k].modulus_mm3)) << piece.name;
            EXPECT_NEAR(after[k].width, before[k].width, 1e-9 * (1 + before[k].width)) << piece.name;
        }
    }
}

TEST(Workholding, ScalesWithStrengthsAndNeverPassesWithMoreForce) {
    const TriangleMesh mesh = frustum(25, 40, 110, 40);
    Cell cell = ready_cell();
    const Workholding one = check_of(mesh, cell);
    bool passed = true;
    for (const double force : {0.5, 5.0, 20.0, 50.0, 500.0}) {
        cell.machine->holding.cutting_force = force;
        const Workholding check = check_of(mesh, cell);
        EXPECT_EQ(check.joint_force, one.joint_force);
        EXPECT_EQ(check.foam_force, one.foam_force);
        EXPECT_TRUE(passed || !check.passes()) << force;
        passed = check.passes();
    }
    EXPECT_FALSE(passed);
    cell.machine->holding.strength *= 2;
    cell.stock[0].bending_strength = 3 * 0.6;
    EXPECT_NEAR(check_of(mesh, cell).joint_force, 2 * one.joint_force, 1e-9);
    EXPECT_NEAR(check_of(mesh, cell).foam_force, 3 * one.foam_force, 1e-9);
}

// A ball lies on a point, but milled from straight above it stands on a cylinder of foam of its own radius.
TEST(StandingSections, FoamThatStaysUnderAPieceCarriesIt) {
    const TriangleMesh mesh = shapes::moved(shapes::ball({0, 0, 0}, 40, 24), {0, 0, 40});
    qchopper::Setup setup = standing(mesh);
    setup.piece_in_setup.shift.z = -setup.box.min.z;
    setup.box = {{setup.box.min.x, setup.box.min.y, 0}, {setup.box.max.x, setup.box.max.y, setup.box.size().z}};
    EXPECT_LT(standing_sections(mesh, setup).front().area_mm2, 100);
    StockPoints stock_points(mesh, setup.piece_in_setup, setup.box, 1U << 18U);
    stock_points.mill(height_field(mesh, {0, 0, 1}, 0.5));
    const double r = setup.box.size().x / 2;
    for (const StandingSection& s : standing_sections(mesh, setup, &stock_points)) {
        EXPECT_NEAR(s.area_mm2, pi * r * r, 0.05 * pi * r * r) << s.z;
        EXPECT_NEAR(s.modulus_mm3, pi * r * r * r / 4, 0.08 * pi * r * r * r / 4) << s.z;
    }
}

// A bar of 30 x 30 x 140 that may stand on its end, base 0, or lie on its side, base 1. With a notch from z = 20 up to
// its end, into which a tool along z reaches and one along x does not.
Piece bar(bool is_notched) {
    TriangleMesh mesh = cell_solid({0, 5, 20, 30}, {0, 20, 30}, {0, 20, 140}, [is_notched](Vec3 p) {
        return !is_notched || p.x < 5 || p.x > 20 || p.y < 20 || p.z < 20;
    });
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        if (mesh.points[a].x + mesh.points[b].x + mesh.points[c].x == 0) mesh.cap_of[t] = 1;
    }
    return {"A", std::make_shared<TriangleMesh>(mesh), {{0, {{0, 0, 1}, 0}, true}, {1, {{1, 0, 0}, 0}, true}}};
}

SetupOptions quick() {
    SetupOptions options;
    options.samples = 1000;
    options.map.stock_points = 1U << 14U;
    return options;
}

TEST(Workholding, PlanningLaysABarThatWouldStandUnheld) {
    Cell cell = ready_cell("gantry-3axis.toml");
    SetupOptions options = quick();
    const SetupChoice held = choose_setup(bar(false), cell, options);
    EXPECT_EQ(held.setups.front().base, 1) << "on its side";
    EXPECT_TRUE(held.setups.front().workholding->passes());
    ASSERT_EQ(held.setups.size(), 2U);
    EXPECT_FALSE(held.setups.back().workholding->passes());
    options.base = 0;
    EXPECT_EQ(choose_setup(bar(false), cell, options).setups.front().base, 0) << "the operator's choice";
    options.base.reset();
    cell.machine->holding = {0.1, 1, 100};  // nothing pushes
    EXPECT_EQ(choose_setup(bar(false), cell, options).setups.front().base, 0) << "of two that are equal the first";
}

// Standing it leaves nothing out of reach, lying the whole notch.
TEST(Workholding, IsPreferredUpToTheLimitOfWhatIsOutOfReach) {
    Cell cell = ready_cell("gantry-3axis.toml");
    const SetupChoice reached = choose_setup(bar(true), cell, quick());
    EXPECT_EQ(reached.setups.front().base, 0);
    EXPECT_FALSE(reached.setups.front().workholding->passes()) << "and it is told";
    EXPECT_LT(reached.setups.front().access.unreachable_share(), 0.02);
    ASSERT_EQ(reached.setups.size(), 2U);
    EXPECT_TRUE(reached.setups.back().workholding->passes());
    EXPECT_GT(reached.setups.back().access.unreachable_share(), 0.1);
    cell.machine->max_unreachable = 0.5;
    EXPECT_EQ(choose_setup(bar(true), cell, quick()).setups.front().base, 1);
}

TEST(Workholding, IsNotCheckedInACellOfVersion1) {
    EXPECT_FALSE(choose_setup(bar(false), cell(), coarse()).setups.front().workholding);
}

}  // namespace
}  // namespace qchopper
