#include "segment/access/unreachable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "segment/access/piece_access.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/segment/objectives/extruded.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

// All of a piece that unreachable_area asks for.
struct Whole {
    explicit Whole(const TriangleMesh& mesh, std::size_t samples = 5'000)
        : scan(sampled(mesh, samples)), pieces(uncut_pieces(scan)) {}
    void cut(Vec3 normal, double share) {
        cut_at(scan, pieces, 0, canonical({normalized(normal), 0}).normal, share, ++cuts);
    }
    SampledScan scan;
    std::vector<TrackedPiece> pieces;
    std::int32_t cuts = 0;
};

UnreachableArea area_of(const SampledScan& scan, const TrackedPiece& piece, const TiltBase& base, double tilt,
                        std::span<const Vec3> further = {}) {
    const std::vector<OwnedCap> caps = owned_caps(piece.piece);
    return unreachable_area({scan, piece.accessibility, caps}, base, tilt, further);
}

TiltBase base_of(const TrackedPiece& piece) {
    const HalfSpace& last = piece.piece.half_spaces.back();
    return {last.up(), last.cut};
}

// Share of the slot's floor that is open along some of the directions within the tilt of z.
double open_floor(const Whole& slot, std::span<const Vec3> directions, double tilt) {
    const TrackedPiece& piece = slot.pieces[0];
    const PieceRays rays(slot.scan, piece.accessibility);
    std::size_t all = 0;
    std::size_t open = 0;
    for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
        const SurfaceSample& sample = slot.scan.samples.sample[piece.accessibility.sample[row]];
        if (sample.normal.z < 0.9 || std::abs(sample.point.z - 10) > 1e-6 || std::abs(sample.point.y) > 2'500) continue;
        ++all;
        const auto is_open = [&](std::uint32_t k) { return std::isinf(rays.distance(row, directions[k])); };
        const std::vector<std::uint32_t> allowed = allowed_directions(directions, {0, 0, 1}, tilt);
        open += std::any_of(allowed.begin(), allowed.end(), is_open) ? 1 : 0;
    }
    EXPECT_GT(all, 1'000U);
    return static_cast<double>(open) / static_cast<double>(all);
}

double expected_open_floor(std::span<const Vec3> directions, double tilt) {
    double steepest = 0;
    for (const std::uint32_t k : allowed_directions(directions, {0, 0, 1}, tilt)) {
        steepest = std::max(steepest, directions[k].x / directions[k].z);
    }
    return std::min(1.0, steepest / 3);
}

// Depth 30 along x, height 10 along z: what leaves a point at the depth s has climbed s d_z / d_x.
TEST(Unreachable, AHorizontalSlotIsOpenAsFarAsItsDirectionsSee) {
    const TriangleMesh mesh =
        extruded({{0, 0}, {50, 0}, {50, 10}, {20, 10}, {20, 20}, {50, 20}, {50, 30}, {0, 30}}, -3'000, 3'000);
    ASSERT_TRUE(edges(mesh).faults.is_closed());
    ASSERT_GT(volume_mm3(mesh), 0);
    const Whole slot(mesh, 10'000);
    const std::vector<Vec3> directions = tool_directions(world);
    const std::vector<Vec3> dense = dense_directions();
    for (const auto& [tilt, known] :
         {std::array{30.0, 0.0}, std::array{45.0, 0.333}, std::array{60.0, 0.499}, std::array{70.0, 0.805}}) {
        if (known > 0) {
            EXPECT_NEAR(expected_open_floor(directions, tilt), known, 1e-3);
        }
        EXPECT_NEAR(open_floor(slot, directions, tilt), expected_open_floor(directions, tilt), 0.015) << tilt;
        const double of_all = std::min(1.0, std::tan(tilt * std::numbers::pi / 180) / 3);
        const double of_dense = expected_open_floor(dense, tilt);
        EXPECT_NEAR(open_floor(slot, dense, tilt), of_dense, 0.015) << tilt;
        EXPECT_LE(of_dense, of_all);
        EXPECT_GT(of_dense, 0.9 * of_all);
    }
}

TEST(Unreachable, AConvexSolidHidesOnlyWhatFacesDown) {
    for (const auto& mesh : {shapes::ball({5, -3, 2}, 25, 40), shapes::pyramid({0, 0, 0}, 20, 50),
                             shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}, 8), {1, 2, 3}, 0.7)}) {
        for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.1, 0.05, 1}, Vec3{1, 2, -1}}) {
            Whole whole(mesh, 3'000);
            whole.cut(normal, 0.45);
            ASSERT_EQ(whole.pieces.size(), 2U);
            for (const TrackedPiece& piece : whole.pieces) {
                const TiltBase base = base_of(piece);
                const std::vector<std::uint32_t> allowed = allowed_directions(whole.scan.directions, base.up, 90);
                std::size_t hidden = 0;
                for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
                    const auto is_open = [&](std::uint32_t k) { return piece.accessibility.is_open(row, k); };
                    if (std::any_of(allowed.begin(), allowed.end(), is_open)) continue;
                    ++hidden;
                    const Vec3 n = whole.scan.samples.sample[piece.accessibility.sample[row]].normal;
                    EXPECT_GE(-dot(n, base.up), std::cos(23 * std::numbers::pi / 180));
                }
                const UnreachableArea area = area_of(whole.scan, piece, base, 90);
                EXPECT_NEAR(area.total_mm2(90), whole.scan.samples.area_each_mm2 * static_cast<double>(hidden), 1e-6);
            }
        }
    }
}

TEST(Unreachable, GrowingTheTiltNeverMakesItLarger) {
    std::mt19937 random(31);
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        Whole whole(mesh, 1'000);
        const double rounding = 1e-6 * whole.scan.samples.area_each_mm2;
        whole.cut(random_normal(random), 0.4);
        whole.cut(random_normal(random), 0.6);
        for (const TrackedPiece& piece : whole.pieces) {
            for (const HalfSpace& half_space : piece.piece.half_spaces) {
                double before = std::numeric_limits<double>::infinity();
                double dense_before = before;
                for (const double tilt : {0.0, 5.0, 14.9, 15.0, 30.0, 60.0, 75.0, 90.0}) {
                    const TiltBase base{half_space.up(), half_space.cut};
                    const double now = area_of(whole.scan, piece, base, tilt).total_mm2(90);
                    const double dense = area_of(whole.scan, piece, base, tilt, dense_directions(300)).total_mm2(90);
                    EXPECT_LE(now, before + rounding) << name << " " << tilt;
                    EXPECT_LE(dense, dense_before + rounding) << name << " " << tilt;
                    EXPECT_LE(dense, now + rounding) << name << " " << tilt;
                    before = now;
                    dense_before = dense;
                }
            }
        }
    }
}

TEST(Unreachable, TurningModelPlanesAndDirectionsTogetherChangesNothing) {
    const Vec3 axis{1, 2, 3};
    const auto turned = [&](Vec3 v) { return shapes::rotated({{v}, {}, {}}, axis, 0.7).points[0]; };
    for (const TriangleMesh& mesh : {shapes::nested(), shapes::torus({0, 0, 0}, 40, 12), shapes::stairs()}) {
        Whole upright(mesh, 2'000);
        Whole other(shapes::rotated(mesh, axis, 0.7), 2'000);
        other.scan.directions.clear();
        for (const Vec3& d : upright.scan.directions) other.scan.directions.push_back(turned(d));
        other.pieces = uncut_pieces(other.scan);
        const Vec3 normal = canonical({normalized({0.3, -0.2, 1}), 0}).normal;
        upright.cut(normal, 0.4);
        // cut() makes the normal canonical: the share counts from the other end where that turns it round.
        const bool is_turned_round = dot(canonical({turned(normal), 0}).normal, turned(normal)) < 0;
        other.cut(turned(normal), is_turned_round ? 0.6 : 0.4);
        ASSERT_EQ(upright.pieces.size(), other.pieces.size());
        for (const double tilt : {0.0, 30.0, 60.0, 90.0}) {
            double before = 0;
            double after = 0;
            for (const TrackedPiece& piece : upright.pieces) {
                if (piece.piece.half_spaces.empty()) continue;
                before += area_of(upright.scan, piece, base_of(piece), tilt).total_mm2(90);
            }
            for (const TrackedPiece& piece : other.pieces) {
                if (piece.piece.half_spaces.empty()) continue;
                after += area_of(other.scan, piece, base_of(piece), tilt).total_mm2(90);
            }
            EXPECT_TRUE(before > 0 || tilt > 0);
            EXPECT_NEAR(after, before, 3 * upright.scan.samples.area_each_mm2) << tilt;
        }
    }
}

// The states of every sample, as the reference finds them, counted.
TEST(Unreachable, EqualsTheReferenceOnReallyCutPieces) {
    std::mt19937 random(32);
    std::size_t compared = 0;
    SampleOptions options;
    options.faces = 5'000;
    for (const TriangleMesh& mesh :
         {shapes::torus({0, 0, 0}, 40, 12), shapes::nested(), shapes::stairs(), sample(Specimen::vertebra, options)}) {
        Whole whole(mesh, 500);
        whole.cut(random_normal(random), 0.4);
        whole.cut(random_normal(random), 0.6);
        for (const TrackedPiece& piece : whole.pieces) {
            const CutPieceReference reference(whole.scan, piece);
            const TiltBase base = base_of(piece);
            for (const double tilt : {0.0, 30.0, 60.0, 90.0}) {
                std::vector<Vec3> directions{base.up};
                for (const Vec3& d : whole.scan.directions) {
                    if (is_allowed(d, base.up, tilt)) directions.push_back(d);
                }
                int steep = 0;
                int hidden = 0;
                for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
                    const Vec3 n = whole.scan.samples.sample[piece.accessibility.sample[row]].normal;
                    bool is_open = false;
                    bool is_steep = false;
                    for (const Vec3& d : directions) {
                        is_open = is_open || reference.is_open(row, d, true);
                        is_steep = is_steep || std::abs(dot(n, d)) < 0.05;
                    }
                    if (!is_open) ++(is_steep ? steep : hidden);
                }
                const UnreachableArea area = area_of(whole.scan, piece, base, tilt);
                const double each = whole.scan.samples.area_each_mm2;
                EXPECT_NEAR(area.steep_mm2 / each, steep, 1e-6) << tilt;
                EXPECT_NEAR(area.hidden_mm2 / each, hidden, 1e-6) << tilt;
                ++compared;
            }
        }
    }
    EXPECT_GE(compared, 48U);
}

TEST(Unreachable, VerticalWallsAreSteepAndCountFrom15Degrees) {
    Whole box(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    box.cut({0, 0, 1}, 0.5);
    for (const TrackedPiece& piece : box.pieces) {
        const UnreachableArea straight = area_of(box.scan, piece, base_of(piece), 0);
        EXPECT_NEAR(straight.steep_mm2, 4 * 40 * 20, 100);
        EXPECT_EQ(straight.hidden_mm2, 0);
        EXPECT_EQ(straight.total_mm2(0), 0);
        EXPECT_EQ(straight.total_mm2(15), straight.steep_mm2);
        EXPECT_EQ(area_of(box.scan, piece, base_of(piece), 30).total_mm2(30), 0);
    }
}

TEST(Unreachable, AnUpBesideTheDirectionsIsCast) {
    const Vec3 up = normalized({0.2, 0.1, 1});
    const TriangleMesh mesh =
        shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}), cross({0, 0, 1}, up), std::acos(up.z));
    Whole box(mesh, 3'000);
    box.scan.directions = tool_directions(world);
    box.pieces = uncut_pieces(box.scan);
    ASSERT_EQ(index_of(box.scan.directions, up), box.scan.directions.size());
    ASSERT_TRUE(allowed_directions(box.scan.directions, up, 0).empty());
    const std::vector<OwnedCap> caps;
    const JudgedPiece judged{box.scan, box.pieces[0].accessibility, caps};
    EXPECT_NEAR(projected_area_mm2(judged, up), 1'600, 60);
    const UnreachableArea area = unreachable_area(judged, {up, std::nullopt}, 0);
    EXPECT_NEAR(area.hidden_mm2, 1'600, 60);  // the side it lies on
    EXPECT_NEAR(area.steep_mm2, 4 * 1'600, 60);
}

TEST(Unreachable, CapsThatFaceAwayFromAllDirectionsCount) {
    Whole box(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    const auto cap_area = [](const TrackedPiece& piece, std::int32_t cut) {
        for (const OwnedCap& cap : owned_caps(piece.piece)) {
            if (cap.cut == cut) return cap.area_mm2;
        }
        return 0.0;
    };
    box.cut({0, 0, 1}, 0.5);
    box.cut({1, 0, 1}, 0.5);  // of the part above: a slope that faces down on one side, up on the other
    ASSERT_EQ(box.pieces.size(), 3U);
    int facing_down = 0;
    for (const TrackedPiece& piece : box.pieces) {
        if (piece.piece.half_spaces.size() != 2 || cap_area(piece, 1) == 0 || cap_area(piece, 2) == 0) continue;
        const HalfSpace& first = piece.piece.half_spaces[0];
        const HalfSpace& second = piece.piece.half_spaces[1];
        const bool faces_down = -dot(second.up(), first.up()) < 0;
        const TiltBase base{first.up(), 1};
        EXPECT_NEAR(area_of(box.scan, piece, base, 30).caps_mm2, faces_down ? cap_area(piece, 2) : 0, 1e-9);
        EXPECT_EQ(area_of(box.scan, piece, base, 60).caps_mm2, 0);  // within 45 degrees of level
        facing_down += faces_down ? 1 : 0;
    }
    EXPECT_EQ(facing_down, 1);
}

TEST(Unreachable, ASmallCapIsNoBase) {
    // The cut's cap is the whole foot of the tip, and a hundredth of what the rest projects.
    Whole pyramid(shapes::pyramid({0, 0, 0}, 20, 50), 3'000);
    pyramid.cut({0, 0, 1}, 0.9);
    ASSERT_EQ(pyramid.pieces.size(), 2U);
    const TrackedPiece& tip = pyramid.pieces[0];
    const TrackedPiece& stump = pyramid.pieces[1];
    const std::vector<OwnedCap> tip_caps = owned_caps(tip.piece);
    const std::vector<OwnedCap> stump_caps = owned_caps(stump.piece);
    ASSERT_EQ(tip_caps.size(), 1U);
    ASSERT_EQ(stump_caps.size(), 1U);
    EXPECT_NEAR(tip_caps[0].area_mm2, 4, 1e-6);
    EXPECT_EQ(tip_caps[0].area_mm2, stump_caps[0].area_mm2);
    const auto on_best_base = [&](TrackedPiece piece, const std::vector<OwnedCap>& caps) {
        piece.piece.samples = std::make_shared<const SampledPiece>(SampledPiece{
            std::shared_ptr<const SampledScan>(std::shared_ptr<void>(), &pyramid.scan), piece.accessibility, caps});
        return area_on_best_base(piece.piece, 60);
    };
    const AreaOnBase of_tip = on_best_base(tip, tip_caps);
    EXPECT_EQ(of_tip.base.base.cut, 1);
    EXPECT_EQ(of_tip.base.base.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(of_tip.share(), 0);
    const AreaOnBase of_stump = on_best_base(stump, stump_caps);
    EXPECT_FALSE(of_stump.base.base.cut.has_value());
    EXPECT_NEAR(of_stump.unreachable_mm2, 4, 1e-6);  // upside down, its own cap faces the table
    const JudgedPiece judged_stump{pyramid.scan, stump.accessibility, stump_caps};
    for (const Vec3& axis : world) {
        for (const double sign : {1.0, -1.0}) {
            EXPECT_LE(of_stump.unreachable_mm2,
                      unreachable_area(judged_stump, {sign * axis, std::nullopt}, 60).total_mm2(60));
        }
    }
    EXPECT_NEAR(of_stump.area_mm2, area_mm2(*stump.piece.mesh), 0.02 * area_mm2(*stump.piece.mesh));
    EXPECT_NEAR(of_tip.area_mm2, area_mm2(*tip.piece.mesh) - 4, 0.2 * area_mm2(*tip.piece.mesh));
}

TEST(SawnCaps, AreNoSurfaceThatAToolHasToReach) {
    const OwnedCap under{2, {0, 0, -1}, 100};
    const TiltBase milled{{0, 0, 1}, 1, {}};
    const TiltBase sawn{{0, 0, 1}, 1, {2}};
    const std::vector<Vec3> from_above{{0, 0, 1}};
    EXPECT_TRUE(counts_as_surface(under, milled));
    EXPECT_TRUE(is_out_of_reach(under, milled, from_above));
    EXPECT_FALSE(counts_as_surface(under, sawn));
    EXPECT_FALSE(is_out_of_reach(under, sawn, from_above));
    EXPECT_FALSE(counts_as_surface({1, {0, 0, -1}, 100}, milled)) << "the base";
}

}  // namespace
}  // namespace qchopper
