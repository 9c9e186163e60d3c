#include "cam/setup/choose_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cam/setup/stock_fit.h"
#include "cam/setup/undercut.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "segment/raster/projected_area.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

// Undercut as the specification prints it, triangle by triangle, with nothing shared with the module under test.
double undercut_by_hand(const Piece& piece, const HalfSpace& base) {
    const TriangleMesh& mesh = *piece.mesh;
    double below = 0;
    double all = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!mesh.cap_of.empty() && mesh.cap_of[t] == base.cut) continue;
        const Vec3 a = mesh.points[mesh.triangles[t][0]];
        const Vec3 b = mesh.points[mesh.triangles[t][1]];
        const Vec3 c = mesh.points[mesh.triangles[t][2]];
        const Vec3 n = cross(b - a, c - a);
        const double length = std::hypot(n.x, n.y, n.z);
        if (length == 0) continue;
        const double area = length / 2;
        const double d = (n.x * base.up().x + n.y * base.up().y + n.z * base.up().z) / length;
        if (d < 0) below += -d * area;
        all += std::abs(d) * area;
    }
    return below / all;
}

bool owns(const Piece& piece, std::int32_t cut) {
    const auto& caps = piece.mesh->cap_of;
    return std::find(caps.begin(), caps.end(), cut) != caps.end();
}

void expect_rotation(const Pose& pose) {
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(dot(pose.row[i], pose.row[k]), i == k ? 1 : 0, 1e-12);
    }
    EXPECT_NEAR(dot(pose.row[0], cross(pose.row[1], pose.row[2])), 1, 1e-12);
}

// Coarser than the program's own, where a test looks at many pieces.
SetupOptions quick() {
    SetupOptions options;
    options.samples = 1'000;
    options.map.stock_points = 1U << 16U;
    return options;
}

TEST(ChooseSetup, EveryPieceLiesOnZeroInTheMiddleTurnedNotMirrored) {
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell(), quick()).setups.front();
        const Pose& pose = setup.piece_in_setup;
        expect_rotation(pose);
        const double size = norm(setup.box.size());
        const double rounding = 1e-12 * size + 1e-15 * norm(pose.shift);
        EXPECT_NEAR(setup.box.min.z, 0, rounding) << piece.name;
        EXPECT_NEAR(setup.box.centre().x, 0, rounding) << piece.name;
        EXPECT_NEAR(setup.box.centre().y, 0, rounding) << piece.name;
        EXPECT_GE(setup.box.size().x, setup.box.size().y - 1e-9 * size) << piece.name;
        EXPECT_EQ(bounds(apply(pose, *piece.mesh)), setup.box);
        EXPECT_NEAR(volume_mm3(apply(pose, *piece.mesh)), volume_mm3(*piece.mesh), 1e-9 * volume_mm3(*piece.mesh));
        const Vec3 up = apply(pose, setup.up) - pose.shift;
        EXPECT_NEAR(up.z, 1, 1e-12);
        for (const Vec3& p : piece.mesh->points) {
            EXPECT_LT(norm(apply_inverse(pose, apply(pose, p)) - p), 1e-12 * (size + norm(p)));
        }
    }
}

bool can_carry(const Piece& piece, const HalfSpace& half_space) {
    const double base_mm2 = facing(*piece.mesh, half_space.up(), half_space.cut).base;
    return base_mm2 >= 0.1 * projected_area_mm2(*piece.mesh, half_space.up());
}

TEST(ChooseSetup, EveryCapThatCarriesIsRankedByWhatIsOutOfReach) {
    int with_base = 0;
    for (const Piece& piece : cut_shapes()) {
        const SetupChoice choice = choose_setup(piece, cell(), quick());
        const qchopper::Setup& best = choice.setups.front();
        std::size_t carrying = 0;
        for (const HalfSpace& half_space : piece.half_spaces) {
            if (!owns(piece, half_space.cut) || !can_carry(piece, half_space)) continue;
            ++carrying;
            const auto setup = std::find_if(choice.setups.begin(), choice.setups.end(),
                                            [&](const qchopper::Setup& s) { return s.base_number == half_space.cut; });
            ASSERT_NE(setup, choice.setups.end()) << piece.name;
            EXPECT_EQ(setup->up, half_space.up());
            EXPECT_NEAR(setup->undercut, undercut_by_hand(piece, half_space), 1e-12) << piece.name;
        }
        ASSERT_EQ(choice.setups.size(), carrying == 0 ? 6 : carrying) << piece.name;
        ASSERT_EQ(best.base.has_value(), carrying > 0) << piece.name;
        with_base += carrying > 0 ? 1 : 0;
        EXPECT_EQ(best.access.method, AccessMethod::mapped);
        const bool any_fits = std::any_of(choice.setups.begin(), choice.setups.end(),
                                          [](const qchopper::Setup& s) { return check_stock_fit(s, cell()).fits(); });
        EXPECT_EQ(check_stock_fit(best, cell()).fits(), any_fits);
        for (std::size_t i = 1; i < choice.setups.size(); ++i) {
            const qchopper::Setup& other = choice.setups[i];
            if (check_stock_fit(other, cell()).fits() != any_fits) continue;
            EXPECT_LE(best.access.unreachable_share(), other.access.unreachable_share() + 0.001) << piece.name;
        }
    }
    EXPECT_GT(with_base, 20);
}

TEST(ChooseSetup, MapsAndSamplesAgree) {
    for (const Piece& piece : cut_shapes()) {
        SetupOptions mapped;
        mapped.map.stock_points = 1U << 16U;
        SetupOptions sampled;
        sampled.mapped = 0;
        const std::vector<qchopper::Setup> by_samples = choose_setup(piece, cell(), sampled).setups;
        const qchopper::Setup by_map = choose_setup(piece, cell(), mapped).setups.front();
        const auto same = std::find_if(by_samples.begin(), by_samples.end(),
                                       [&](const qchopper::Setup& s) { return s.base_number == by_map.base_number; });
        ASSERT_NE(same, by_samples.end());
        EXPECT_NEAR(same->access.unreachable_share(), by_map.access.unreachable_share(), 0.03) << piece.name;
    }
}

TEST(ChooseSetup, TheOperatorsBaseComesFirstAndFewerDirectionsReachLess) {
    for (const Piece& piece : cut_shapes()) {
        const SetupChoice free = choose_setup(piece, cell(), quick());
        SetupOptions options = quick();
        options.base = free.setups.back().base_number;
        const SetupChoice ordered = choose_setup(piece, cell(), options);
        EXPECT_EQ(ordered.setups.front().base_number, *options.base) << piece.name;
        EXPECT_EQ(ordered.setups.front().access.method, AccessMethod::mapped);
        options.max_directions = 1;
        options.mapped = 0;
        const SetupChoice single = choose_setup(piece, cell(), options);
        EXPECT_EQ(single.setups.front().access.orientations.size(), 1U);
        options.max_directions = 8;
        const SetupChoice several = choose_setup(piece, cell(), options);
        EXPECT_LE(several.setups.front().access.unreachable_mm2(), single.setups.front().access.unreachable_mm2());
    }
}

TEST(ChooseSetup, StatesBelongToTheSetupThatIsFirst) {
    for (const Piece& piece : cut_shapes()) {
        const SetupChoice choice = choose_setup(piece, cell(), quick());
        ASSERT_EQ(choice.states.size(), piece.mesh->triangles.size());
        double hidden = 0;
        for (std::size_t t = 0; t < choice.states.size(); ++t) {
            if (choice.states[t] == SurfaceState::hidden) hidden += norm(area_vector(*piece.mesh, t));
        }
        const SurfaceAccess& access = choice.setups.front().access;
        EXPECT_NEAR(hidden / access.area_mm2, access.hidden_mm2 / access.area_mm2, 0.05) << piece.name;
    }
}

TEST(ChooseSetup, TheBaseLiesFlatOnTheTable) {
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell(), quick()).setups.front();
        if (!setup.base) continue;
        const TriangleMesh lying = apply(setup.piece_in_setup, *piece.mesh);
        for (std::size_t t = 0; t < lying.triangles.size(); ++t) {
            if (cap_of(lying, t) != *setup.base) continue;
            for (const std::uint32_t corner : lying.triangles[t]) {
                EXPECT_NEAR(lying.points[corner].z, 0, 1e-9 * norm(setup.box.size())) << piece.name;
            }
        }
    }
}

TEST(ChooseSetup, TurningPieceAndBoundsTogetherChangesOnlyWhatDependsOnTheDirectionSet) {
    const Cell in = cell();
    SetupOptions sampled = quick();
    sampled.samples = 4'000;
    sampled.mapped = 1;
    for (const Piece& piece : cut_shapes()) {
        const std::vector<qchopper::Setup> before = choose_setup(piece, in, sampled).setups;
        if (!before.front().base) continue;  // the oriented box is a search, and may end elsewhere
        const std::vector<qchopper::Setup> after =
            choose_setup(rotated(piece, {0.3, -0.5, 0.8}, 1.234, {17, -40, 5}), in, sampled).setups;
        ASSERT_EQ(after.size(), before.size()) << piece.name;
        // A side of a box that only few directions of the set face is reached or not as a whole; the dense ones even
        // that out.
        EXPECT_NEAR(after.front().access.all_directions_share, before.front().access.all_directions_share, 0.05)
            << piece.name;
        for (const qchopper::Setup& setup : before) {
            const auto turned = std::find_if(after.begin(), after.end(), [&](const qchopper::Setup& s) {
                return s.base_number == setup.base_number;
            });
            ASSERT_NE(turned, after.end()) << piece.name;
            EXPECT_NEAR(turned->undercut, setup.undercut, 1e-9) << piece.name;
            EXPECT_EQ(turned->undercut_by_count, setup.undercut_by_count) << piece.name;
            EXPECT_EQ(turned->block.stock, setup.block.stock) << piece.name;
            const Vec3 change = turned->box.size() - setup.box.size();
            EXPECT_LT(norm(change), 1e-6 * norm(setup.box.size())) << piece.name;
        }
    }
}

TEST(ChooseSetup, ABoxOnItsCapHasNoUndercut) {
    const Piece piece = standing_box({10, 20, 30}, {40, 110, 45}, 3, 4);
    const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
    EXPECT_EQ(setup.base, 3);
    EXPECT_EQ(setup.undercut, 0);
    EXPECT_NEAR(setup.access.unreachable_share(), 0, 1e-6);
    EXPECT_NEAR(setup.base_mm2, 30 * 90, 1e-9);
    EXPECT_NEAR(setup.projected_area_mm2, 30 * 90, 27);
    EXPECT_TRUE(setup.warnings.empty());
    EXPECT_NEAR(setup.box.max.x, 45, 1e-9) << "the long side lies along x";
    EXPECT_NEAR(setup.box.max.y, 15, 1e-9);
    EXPECT_NEAR(setup.box.max.z, 15, 1e-9);
    EXPECT_EQ(setup.block.stock, 0U) << "90 + 10 by 30 + 10 by 15 + 5 is in 100 x 60 x 50";
    EXPECT_FALSE(setup.block.is_turned);
}

TEST(ChooseSetup, ATieGoesToTheLowerCut) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {10, 10, 10});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 n = area_vector(mesh, t);
        mesh.cap_of.push_back(n.z < 0 ? 5 : n.x < 0 ? 2 : n.y < 0 ? 9 : no_cap);
    }
    const Piece piece{"A",
                      std::make_shared<TriangleMesh>(mesh),
                      {{5, {{0, 0, 1}, 0}, true}, {2, {{1, 0, 0}, 0}, true}, {9, {{0, 1, 0}, 0}, true}}};
    EXPECT_EQ(choose_setup(piece, cell()).setups.front().base, 2);
}

TEST(ChooseSetup, AHalfSpaceWhoseCapIsGoneIsNoBase) {
    Piece piece = standing_box({0, 0, 0}, {10, 10, 10}, 3);
    piece.half_spaces.insert(piece.half_spaces.begin(), HalfSpace{1, {{0, 0, 1}, -5}, true});
    EXPECT_EQ(choose_setup(piece, cell()).setups.front().base, 3);
}

TEST(ChooseSetup, ACapThatCannotCarryIsNoBase) {
    const Piece whole = uncut(shapes::pyramid({0, 0, 0}, 40, 60));
    const auto halves = cut_piece(whole, {{0, 0, 1}, 54.321}, 0);
    ASSERT_TRUE(halves && halves->pieces.size() == 2);
    const Piece& stump = halves->pieces[1];
    ASSERT_FALSE(stump.half_spaces[0].above);
    EXPECT_EQ(choose_setup(stump, cell()).setups.front().base, std::nullopt) << "its cap is 1 % of its projection";

    const auto again = cut_piece(stump, canonical({{1, 0.1, 0}, 20.77}), 1);
    ASSERT_TRUE(again && again->pieces.size() == 2);
    for (const Piece& half : again->pieces) EXPECT_EQ(choose_setup(half, cell()).setups.front().base, 1);
}

TEST(ChooseSetup, APieceWithoutCapsLiesOnASideOfItsBox) {
    const Piece piece = uncut(shapes::box({0, 0, 0}, {50, 20, 10}));
    const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
    EXPECT_EQ(setup.base, std::nullopt);
    EXPECT_EQ(setup.warnings.size(), 1U);
    // Six sides hide 10 x 20, 10 x 50 or 20 x 50 of 3400: the smallest is the one below.
    EXPECT_NEAR(setup.access.unreachable_share(), 200.0 / 3400, 0.002);
    EXPECT_NEAR(setup.box.size().z, 50, 1e-6);
}

TEST(ChooseSetup, StockIsTheSmallestThatHoldsThePieceEitherWayRound) {
    const Cell in = cell();
    const auto stock_for = [&](Vec3 size) { return choose_setup(standing_box({0, 0, 0}, size, 0), in).setups.front(); };
    EXPECT_EQ(stock_for({90, 50, 45}).block.stock, 0U) << "exactly with its margin";
    EXPECT_TRUE(stock_for({90, 50, 45}).block.holds);
    EXPECT_EQ(stock_for({90.1, 50, 45}).block.stock, 1U);
    EXPECT_EQ(stock_for({50, 50, 100}).block.stock, 2U);
    Cell narrow = in;
    narrow.stock = {{"across", {60, 100, 50}, Material::eps}};
    const qchopper::Setup turned = choose_setup(standing_box({0, 0, 0}, {90, 50, 45}, 0), narrow).setups.front();
    EXPECT_TRUE(turned.block.is_turned);
    EXPECT_EQ(turned.block.size, (Vec3{100, 60, 50}));
    EXPECT_TRUE(turned.block.holds);
}

TEST(ChooseSetup, APieceIsTurnedWhereItsBlockFitsIntoTheCellOnlySo) {
    const Piece piece = standing_box({0, 0, 0}, {90, 50, 45}, 0);
    Cell in = cell();
    in.table.size_x = 80;
    const qchopper::Setup across = choose_setup(piece, in).setups.front();
    EXPECT_NEAR(across.box.size().x, 50, 1e-9);
    EXPECT_NEAR(across.box.size().y, 90, 1e-9);
    expect_rotation(across.piece_in_setup);
    EXPECT_EQ(bounds(apply(across.piece_in_setup, *piece.mesh)), across.box);
    EXPECT_EQ(across.block.size, (Vec3{60, 100, 50}));
    EXPECT_TRUE(check_stock_fit(across, in).fits());
    EXPECT_TRUE(fits_cell(piece, in));
    in.table.size_y = 80;
    const qchopper::Setup neither = choose_setup(piece, in).setups.front();
    EXPECT_NEAR(neither.box.size().x, 90, 1e-9) << "the long side stays along x";
    EXPECT_FALSE(fits_cell(piece, in));
}

TEST(ChooseSetup, TheMachineMustHoldWhatFitsByBoxes) {
    Cell arm = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    const Piece piece = standing_box({0, 0, 0}, {200, 150, 100}, 0);
    EXPECT_TRUE(fits_cell(piece, arm));
    EXPECT_TRUE(fits_cell_and_machine(piece, arm, bases_of(piece)));
    const Cell before = arm;
    arm.machine->obstacles.push_back({"beam", {{-300, -1500, 1200}, {1600, 1500, 1700}}});
    EXPECT_TRUE(fits_cell(piece, arm));
    EXPECT_FALSE(fits_cell_and_machine(piece, arm, bases_of(piece)));
    const Piece large = standing_box({0, 0, 0}, {1200, 1150, 100}, 0);
    EXPECT_FALSE(fits_cell_and_machine(large, before, bases_of(large)));
    const Piece small = standing_box({0, 0, 0}, {90, 50, 45}, 0);
    EXPECT_TRUE(fits_cell_and_machine(small, cell(), bases_of(small)));  // boxes only
}

// Height fields know of the holder, samples do not. One that is held may leave up to the cell's limit. Blocks of this
// cell are sawn, so that areas are compared, of the whole piece.
TEST(ChooseSetup, TheOneThatIsTakenIsJudgedByMapsAndNoOtherLooksBetter) {
    const Cell short_tools = [] {
        Cell in = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "irb6640-185-2.8.toml");
        for (CuttingTool& tool : in.machine->tools) tool.stick_out = 10;
        return in;
    }();
    for (const Piece& piece : cut_shapes()) {
        SetupOptions options;
        options.mapped = 1;
        options.samples = 500;
        options.map = {.cell = 1, .stock_points = 1U << 12U};
        const std::vector<qchopper::Setup> setups = choose_setup(piece, short_tools, options).setups;
        const double whole = area_mm2(*piece.mesh);
        const double area = setups.front().access.unreachable_mm2();
        const double limit = short_tools.machine->max_unreachable * setups.front().access.area_mm2;
        const bool is_held = setups.front().workholding->passes();
        EXPECT_EQ(setups.front().access.method, AccessMethod::mapped);
        for (const qchopper::Setup& setup : setups) {
            if (!check_stock_fit(setup, short_tools).fits()) continue;
            const double other = setup.access.unreachable_mm2();
            EXPECT_LE(area, std::max(other + 0.001 * whole, is_held ? limit : 0)) << piece.name;
            EXPECT_FALSE(!is_held && setup.workholding->passes() && other <= area) << piece.name;
        }
    }
}

TEST(ChooseSetup, WithoutAHoldingBlockTheOneThatLacksLeastIsNamed) {
    const qchopper::Setup setup = choose_setup(standing_box({0, 0, 0}, {150, 150, 410}, 0), cell()).setups.front();
    EXPECT_FALSE(setup.block.holds);
    EXPECT_EQ(setup.block.stock, 2U) << "15 mm too low; the others lack hundreds";
}

}  // namespace
}  // namespace qchopper
