#include "cam/setup/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cam/setup/undercut.h"
#include "segment/mesh/transform.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

// qchopper::Setup in full below: a test is a class that has a Setup of its own.

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

TEST(Setup, EveryPieceLiesOnZeroInTheMiddleTurnedNotMirrored) {
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
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

TEST(Setup, TheBaseIsTheCapWithTheLeastUndercutThatCarries) {
    int with_base = 0;
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
        const bool any = std::any_of(piece.half_spaces.begin(), piece.half_spaces.end(),
                                     [&](const HalfSpace& half_space) { return owns(piece, half_space.cut); });
        ASSERT_EQ(setup.base.has_value(), any) << piece.name;
        if (!any) continue;
        ++with_base;
        for (const HalfSpace& half_space : piece.half_spaces) {
            if (!owns(piece, half_space.cut)) continue;
            const double by_hand = undercut_by_hand(piece, half_space);
            if (half_space.cut == *setup.base) {
                EXPECT_NEAR(setup.undercut, by_hand, 1e-12) << piece.name;
                EXPECT_EQ(setup.up, half_space.up());
            }
            const double base_mm2 = facing(*piece.mesh, half_space.up(), half_space.cut).base;
            if (setup.base_is_stable && base_mm2 > 0.5 * setup.projected_area_mm2) {
                EXPECT_LE(setup.undercut, by_hand + 1e-9) << piece.name;
            }
        }
        EXPECT_GE(setup.undercut, 0);
        EXPECT_LT(setup.undercut, 0.5);
    }
    EXPECT_GT(with_base, 20);
}

TEST(Setup, TheBaseLiesFlatOnTheTable) {
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
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

TEST(Setup, TurningPieceAndBoundsTogetherChangesNothing) {
    const Cell in = cell();
    for (const Piece& piece : cut_shapes()) {
        const qchopper::Setup before = choose_setup(piece, in).setups.front();
        if (!before.base) continue;  // the oriented box is a search, and may end elsewhere
        const qchopper::Setup after =
            choose_setup(rotated(piece, {0.3, -0.5, 0.8}, 1.234, {17, -40, 5}), in).setups.front();
        EXPECT_NEAR(after.undercut, before.undercut, 1e-9) << piece.name;
        EXPECT_NEAR(after.occluded_area_ratio, before.occluded_area_ratio, 0.02)
            << piece.name;  // rays are single precision
        EXPECT_EQ(after.base, before.base) << piece.name;
        EXPECT_EQ(after.block.stock, before.block.stock) << piece.name;
        const Vec3 change = after.box.size() - before.box.size();
        EXPECT_LT(norm(change), 1e-6 * norm(before.box.size())) << piece.name;
    }
}

TEST(Setup, ABoxOnItsCapHasNoUndercut) {
    const Piece piece = standing_box({10, 20, 30}, {40, 110, 45}, 3, 4);
    const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
    EXPECT_EQ(setup.base, 3);
    EXPECT_EQ(setup.undercut, 0);
    EXPECT_EQ(setup.occluded_area_ratio, 0);
    EXPECT_NEAR(setup.base_mm2, 30 * 90, 1e-9);
    EXPECT_NEAR(setup.projected_area_mm2, 30 * 90, 27);
    EXPECT_TRUE(setup.base_is_stable);
    EXPECT_TRUE(setup.warnings.empty());
    EXPECT_NEAR(setup.box.max.x, 45, 1e-9) << "the long side lies along x";
    EXPECT_NEAR(setup.box.max.y, 15, 1e-9);
    EXPECT_NEAR(setup.box.max.z, 15, 1e-9);
    EXPECT_EQ(setup.block.stock, 0U) << "90 + 10 by 30 + 10 by 15 + 5 is in 100 x 60 x 50";
    EXPECT_FALSE(setup.block.is_turned);
}

TEST(Setup, ATieGoesToTheLowerCut) {
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

TEST(Setup, AHalfSpaceWhoseCapIsGoneIsNoBase) {
    Piece piece = standing_box({0, 0, 0}, {10, 10, 10}, 3);
    piece.half_spaces.insert(piece.half_spaces.begin(), HalfSpace{1, {{0, 0, 1}, -5}, true});
    EXPECT_EQ(choose_setup(piece, cell()).setups.front().base, 3);
}

// A pyramid standing on its cut tip has more undercut but the tip, were it the only cap, is what there is.
TEST(Setup, ABaseThatCannotCarryIsPassedOverOrTakenWithAWarning) {
    const Piece whole = uncut(shapes::pyramid({0, 0, 0}, 40, 60));
    const auto halves = cut_piece(whole, {{0, 0, 1}, 54.321}, 0);
    ASSERT_TRUE(halves && halves->pieces.size() == 2);
    const Piece& stump = halves->pieces[1];
    ASSERT_FALSE(stump.half_spaces[0].above);
    const qchopper::Setup on_tip = choose_setup(stump, cell()).setups.front();
    EXPECT_EQ(on_tip.base, 0);
    EXPECT_FALSE(on_tip.base_is_stable);
    ASSERT_EQ(on_tip.warnings.size(), 1U);
    EXPECT_NE(on_tip.warnings[0].find("1 % of the piece's projected area"), std::string::npos) << on_tip.warnings[0];

    const auto again = cut_piece(stump, canonical({{1, 0.1, 0}, 20.77}), 1);
    ASSERT_TRUE(again && again->pieces.size() == 2);
    for (const Piece& half : again->pieces) EXPECT_EQ(choose_setup(half, cell()).setups.front().base, 1);
}

TEST(Setup, APieceWithoutCapsLiesOnASideOfItsBox) {
    const Piece piece = uncut(shapes::box({0, 0, 0}, {50, 20, 10}));
    const qchopper::Setup setup = choose_setup(piece, cell()).setups.front();
    EXPECT_EQ(setup.base, std::nullopt);
    EXPECT_FALSE(setup.base_is_stable);
    EXPECT_EQ(setup.warnings.size(), 1U);
    // Six sides hide 10 x 20, 10 x 50 or 20 x 50 of 3400: the smallest is the one below.
    EXPECT_NEAR(setup.occluded_area_ratio, 200.0 / 3400, 1e-6);
    EXPECT_NEAR(setup.box.size().z, 50, 1e-6);
}

TEST(Setup, StockIsTheSmallestThatHoldsThePieceEitherWayRound) {
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

TEST(Setup, WithoutAHoldingBlockTheOneThatLacksLeastIsNamed) {
    const qchopper::Setup setup = choose_setup(standing_box({0, 0, 0}, {150, 150, 410}, 0), cell()).setups.front();
    EXPECT_FALSE(setup.block.holds);
    EXPECT_EQ(setup.block.stock, 2U) << "15 mm too low; the others lack hundreds";
}

}  // namespace
}  // namespace qchopper
