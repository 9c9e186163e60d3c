// Areas that are known, and what may not change them: tilt, further bases, turning, threads.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "segment/access/access_sweep.h"
#include "segment/mesh/measure.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/segment/access/swept_planes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A piece with two caps, its sweep for several tilts.
struct Sample {
    explicit Sample(const TriangleMesh& mesh, std::size_t samples = 2'000, int cuts = 2)
        : scan(sampled(mesh, samples)), pieces(uncut_pieces(scan)) {
        std::mt19937 random(44);
        for (std::int32_t number = 1; number <= cuts; ++number) {
            const std::size_t made = cut_at(scan, pieces, 0, random_normal(random), 0.4, number);
            if (made > 0) pieces = {pieces[pieces.size() - made]};
        }
        caps = owned_caps(pieces[0].piece);
    }
    JudgedPiece judged() const { return {scan, pieces[0].accessibility, caps}; }
    std::vector<PlaneAccess> sweep(Vec3 normal, double tilt, int planes = 20) const {
        return AccessSweep(pieces[0].piece, judged(), tilt).sweep(normal, offsets(normal, planes));
    }
    std::vector<double> offsets(Vec3 normal, int planes) const {
        const Extent range = extent(*pieces[0].piece.mesh, normal);
        std::vector<double> result;
        for (int j = 1; j <= planes; ++j) result.push_back(range.low + range.size() * j / (planes + 1));
        return result;
    }
    SampledScan scan;
    std::vector<TrackedPiece> pieces;
    std::vector<OwnedCap> caps;
};

TEST(AccessSweep, GrowingTheTiltNeverMakesTheAreaLarger) {
    std::mt19937 random(45);
    std::size_t smaller = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Sample piece(mesh, 500);
        for (const Vec3 normal : {random_normal(random), canonical({piece.scan.directions[40], 0}).normal}) {
            std::vector<PlaneAccess> before = piece.sweep(normal, 15);
            for (const double tilt : {30.0, 60.0, 75.0, 90.0}) {
                const std::vector<PlaneAccess> now = piece.sweep(normal, tilt);
                for (std::size_t j = 0; j < now.size(); ++j) {
                    for (const bool above : {true, false}) {
                        const auto a = side(before[j], above);
                        const auto b = side(now[j], above);
                        ASSERT_EQ(a.size(), b.size());
                        for (std::size_t i = 0; i < a.size(); ++i) {
                            EXPECT_LE(b[i].unreachable_mm2, a[i].unreachable_mm2 * (1 + 1e-12)) << name << " " << tilt;
                            smaller += b[i].unreachable_mm2 < a[i].unreachable_mm2 ? 1 : 0;
                        }
                    }
                }
                before = now;
            }
        }
    }
    EXPECT_GT(smaller, 100U);
}

TEST(AccessSweep, AFurtherBaseNeverMakesTheLeastLarger) {
    std::mt19937 random(46);
    std::size_t smaller = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Sample piece(mesh, 500);
        for (int i = 0; i < 4; ++i) {
            for (const PlaneAccess& access : piece.sweep(random_normal(random), 60)) {
                for (const bool above : {true, false}) {
                    const std::span<const SideOnBase> all = side(access, above);
                    for (std::size_t count = 1; count < all.size(); ++count) {
                        const auto few = all.first(count);
                        // Where none carries, one that does is taken, whatever its area.
                        if (std::none_of(few.begin(), few.end(), [](const SideOnBase& b) { return b.is_stable(); })) {
                            continue;
                        }
                        const double less = best_base(all.first(count + 1)).unreachable_mm2;
                        EXPECT_LE(less, best_base(few).unreachable_mm2) << name;
                        smaller += less < best_base(few).unreachable_mm2 ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_GT(smaller, 10U);
}

TEST(AccessSweep, TheLeastIsThatOfTheBasesThatCarry) {
    const SideOnBase carries{1, 30, 0, 10, 100};
    const SideOnBase also{2, 20, 0, 50, 100};
    const SideOnBase too_small{3, 5, 0, 9.9, 100};
    EXPECT_EQ(best_base(std::array{carries, too_small, also}).unreachable_mm2, 20);
    EXPECT_EQ(best_base(std::array{too_small, carries}).unreachable_mm2, 30);
    EXPECT_EQ(best_base(std::array{too_small}).unreachable_mm2, 5);
}

TEST(AccessSweep, TurningModelPlanesAndDirectionsTogetherChangesNothing) {
    const Vec3 axis{1, 2, 3};
    const auto turned = [&](Vec3 v) { return shapes::rotated({{v}, {}, {}}, axis, 0.7).points[0]; };
    for (const TriangleMesh& mesh : {shapes::nested(), shapes::torus({0, 0, 0}, 40, 12), shapes::stairs()}) {
        SampledScan scans[2] = {sampled(mesh, 2'000), sampled(shapes::rotated(mesh, axis, 0.7), 2'000)};
        scans[1].directions.clear();
        for (const Vec3& d : scans[0].directions) scans[1].directions.push_back(turned(d));
        std::vector<TrackedPiece> pieces[2];
        for (int i = 0; i < 2; ++i) {
            const Vec3 first = normalized({1, 0.4, 0.2});
            pieces[i] = uncut_pieces(scans[i]);
            ASSERT_GE(cut_along(scans[i], pieces[i], 0, {i == 0 ? first : turned(first), 1.3}, 1), 2U);
        }
        for (const double tilt : tilts) {
            for (const Vec3 normal : {normalized({0.3, -0.2, 1}), scans[0].directions[17]}) {
                std::vector<PlaneAccess> access[2];
                for (int i = 0; i < 2; ++i) {
                    const TrackedPiece& piece = pieces[i].back();
                    const std::vector<OwnedCap> caps = owned_caps(piece.piece);
                    const JudgedPiece judged{scans[i], piece.accessibility, caps};
                    access[i] = AccessSweep(piece.piece, judged, tilt)
                                    .sweep(i == 0 ? normal : turned(normal), std::array{-7.7, 1.234, 6.1});
                }
                const double few = 4 * scans[0].samples.area_each_mm2;
                for (std::size_t j = 0; j < access[0].size(); ++j) {
                    for (const bool above : {true, false}) {
                        const auto before = side(access[0][j], above);
                        const auto after = side(access[1][j], above);
                        ASSERT_EQ(before.size(), after.size());
                        for (std::size_t b = 0; b < before.size(); ++b) {
                            EXPECT_NEAR(after[b].unreachable_mm2, before[b].unreachable_mm2, few) << tilt;
                            EXPECT_NEAR(after[b].base_mm2, before[b].base_mm2, few);
                            EXPECT_NEAR(after[b].projected_mm2, before[b].projected_mm2, few);
                        }
                    }
                }
            }
        }
    }
}

TEST(AccessSweep, AConvexSolidHidesOnlyWhatFacesDown) {
    std::mt19937 random(47);
    for (const auto& mesh : {shapes::ball({5, -3, 2}, 25, 40), shapes::pyramid({0, 0, 0}, 20, 50),
                             shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}, 8), {1, 2, 3}, 0.7)}) {
        const Sample piece(mesh, 3'000, 1);
        ASSERT_EQ(piece.caps.size(), 1U);
        for (int i = 0; i < 5; ++i) {
            const Vec3 normal = random_normal(random);
            const std::vector<double> offsets = piece.offsets(normal, 20);
            const std::vector<PlaneAccess> planes = piece.sweep(normal, 90);
            for (std::size_t j = 0; j < planes.size(); ++j) {
                for (const bool above : {true, false}) {
                    for (const SideOnBase& s : side(planes[j], above)) {
                        const Vec3 up = s.cut != new_cut ? -piece.caps[0].outward : above ? normal : -normal;
                        std::size_t down = 0;
                        for (const std::uint32_t k : piece.pieces[0].accessibility.sample) {
                            const SurfaceSample& sample = piece.scan.samples.sample[k];
                            if ((height(normal, sample.point) >= offsets[j]) != above) continue;
                            down += dot(sample.normal, up) <= -std::cos(23 * std::numbers::pi / 180) ? 1 : 0;
                        }
                        EXPECT_LE(s.unreachable_mm2 - s.caps_mm2,
                                  (static_cast<double>(down) + 1e-6) * piece.scan.samples.area_each_mm2);
                    }
                }
            }
        }
    }
}

// A bar of 40 x 40 x 120 mm: areas are known.
TEST(AccessSweep, AreasOfABarAreKnown) {
    const Sample bar(shapes::box({0, 0, 0}, {40, 40, 120}), 8'000, 0);
    const double each = bar.scan.samples.area_each_mm2;
    for (const PlaneAccess& access : bar.sweep({0, 0, 1}, 60)) {
        for (const bool above : {true, false}) {
            ASSERT_EQ(side(access, above).size(), 1U);
            const SideOnBase& s = side(access, above).front();
            EXPECT_EQ(s.cut, new_cut);
            EXPECT_EQ(s.unreachable_mm2, 0);
            EXPECT_NEAR(s.base_mm2, 1'600, 4 * each);
            EXPECT_NEAR(s.projected_mm2, 1'600, 4 * each);
            EXPECT_TRUE(s.is_stable());
        }
    }
    for (const PlaneAccess& access : bar.sweep({0, 0, 1}, 0))
        EXPECT_EQ(best_base(access.above).unreachable_mm2, 0);  // steep
    const std::vector<PlaneAccess> beside =
        AccessSweep(bar.pieces[0].piece, bar.judged(), 60).sweep({0, 0, 1}, std::array{-1.0, 121.0});
    EXPECT_EQ(beside[0].below[0].unreachable_mm2, 0);  // no sample
    EXPECT_EQ(beside[1].above[0].unreachable_mm2, 0);
    EXPECT_NEAR(beside[0].above[0].unreachable_mm2, 1'600, 4 * each);  // the whole bar, and its foot
    EXPECT_TRUE(AccessSweep(bar.pieces[0].piece, bar.judged(), 60).sweep({0, 0, 1}, {}).empty());
}

// cut_accessibility and cut() count height == offset as above.
TEST(AccessSweep, ASampleOnThePlaneBelongsToTheSideAbove) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    ASSERT_EQ(cut_along(scan, pieces, 0, {{0, 0, 1}, 10}, 1), 2U);
    const TrackedPiece& lower = pieces[1];
    ASSERT_FALSE(lower.piece.half_spaces[0].above);
    const std::vector<OwnedCap> caps = owned_caps(lower.piece);
    // Its foot lies at height 0 to the last bit; it is the top on the old base.
    const AccessSweep sweep(lower.piece, {scan, lower.accessibility, caps}, 60);
    const PlaneAccess at_foot = sweep.sweep({0, 0, 1}, std::array{0.0})[0];
    EXPECT_NEAR(projected_area_mm2({scan, lower.accessibility, caps}, {0, 0, 1}), 1'600, 1e-6);  // its cap alone
    ASSERT_EQ(at_foot.above.size(), 2U);
    ASSERT_EQ(at_foot.below.size(), 1U);
    EXPECT_EQ(at_foot.below[0].projected_mm2, 0);
    EXPECT_NEAR(at_foot.above[1].projected_mm2, 1'600, 4 * scan.samples.area_each_mm2);
    EXPECT_NEAR(at_foot.above[0].unreachable_mm2, 1'600, 4 * scan.samples.area_each_mm2);
    // The same upside down: the side that the normal points away from loses it.
    const PlaneAccess from_under = sweep.sweep({0, 0, -1}, std::array{0.0})[0];
    ASSERT_EQ(from_under.below.size(), 2U);
    EXPECT_NEAR(from_under.below[1].projected_mm2, 1'600, 1e-6);  // the new cap, where the foot was
    EXPECT_NEAR(from_under.above[0].unreachable_mm2, 0, 1e-9);
    EXPECT_NEAR(from_under.above[0].projected_mm2, 1'600, 4 * scan.samples.area_each_mm2);
}

// An old cap that faces down, beside the new base, and parts of it on both sides.
TEST(AccessSweep, CapsThatFaceAwayCountByTheirAreaOnTheSide) {
    const SampledScan scan = sampled(shapes::box({0, 0, 0}, {40, 40, 40}), 3'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    ASSERT_EQ(cut_along(scan, pieces, 0, {{0, 0, 1}, 10}, 1), 2U);
    const TrackedPiece& upper = pieces[0];
    ASSERT_TRUE(upper.piece.half_spaces[0].above);
    const std::vector<OwnedCap> caps = owned_caps(upper.piece);
    const JudgedPiece judged{scan, upper.accessibility, caps};
    const AccessSweep sweep(upper.piece, judged, 30);
    // Across the old cap: parts of 40 x 15 and 40 x 25 mm face sideways, which a tool tilted by 30 degrees cannot reach
    // from a base at right angles.
    const PlaneAccess across = sweep.sweep({1, 0, 0}, std::array{15.0})[0];
    ASSERT_EQ(across.below.size(), 2U);
    ASSERT_EQ(across.above.size(), 2U);
    EXPECT_NEAR(across.below[1].base_mm2, 600, 1e-6);
    EXPECT_NEAR(across.above[1].base_mm2, 1'000, 1e-6);
    EXPECT_EQ(across.below[0].caps_mm2, 0);
    // The new cap stands upright on the old base, and a tilted tool reaches it.
    EXPECT_EQ(across.below[1].caps_mm2, 0);
    // Parallel to it: the old cap, face down on nothing but the new base's opposite.
    const PlaneAccess parallel = sweep.sweep({0, 0, 1}, std::array{25.0})[0];
    ASSERT_EQ(parallel.above.size(), 1U);
    ASSERT_EQ(parallel.below.size(), 2U);
    EXPECT_NEAR(parallel.below[1].base_mm2, 1'600, 1e-6);
    EXPECT_EQ(parallel.below[0].caps_mm2, 0);  // on the new base the old cap faces up
    EXPECT_EQ(parallel.below[1].caps_mm2, 0);
    // Slanting, with the old cap as the roof of an overhang above the plane.
    const Vec3 slanting = normalized({1, 0, 1});
    const PlaneAccess roof = sweep.sweep(slanting, std::array{dot(slanting, {20, 0, 10})})[0];
    ASSERT_EQ(roof.above.size(), 2U);
    EXPECT_NEAR(roof.above[1].base_mm2, 800, 1e-6);
    EXPECT_NEAR(roof.above[0].caps_mm2, 800, 1e-6);
    EXPECT_NEAR(roof.above[1].caps_mm2, roof.above[0].base_mm2, 1e-6);
    EXPECT_EQ(roof.below[0].caps_mm2, 0);
    EXPECT_EQ(roof.below[1].caps_mm2, 0);
}

TEST(AccessSweep, TheNewCapHasTheAreaOfTheCut) {
    std::mt19937 random(48);
    for (const TriangleMesh& mesh : {small_specimen(Specimen::vertebra), shapes::torus({0, 0, 0}, 40, 12)}) {
        for (const int cuts : {0, 2}) {
            const Sample piece(mesh, 5'000, cuts);
            for (int i = 0; i < 10; ++i) {
                const Vec3 normal = random_normal(random);
                const std::vector<double> offsets = piece.offsets(normal, 9);
                const std::vector<PlaneAccess> planes = piece.sweep(normal, 60, 9);
                for (const std::size_t j : {2U, 4U, 6U}) {
                    const auto halves = qchopper::cut(*piece.pieces[0].piece.mesh, {normal, offsets[j]}, 9);
                    ASSERT_TRUE(halves);
                    EXPECT_NEAR(planes[j].below[0].base_mm2, halves->cap_area_mm2, 0.005 * area_mm2(mesh));
                    EXPECT_EQ(planes[j].below[0].base_mm2, planes[j].above[0].base_mm2);
                }
            }
        }
    }
}

TEST(AccessSweep, IsTheSameForAnyNumberOfThreads) {
    const Sample piece(small_specimen(Specimen::skull), 3'000);
    ASSERT_EQ(piece.caps.size(), 2U);
    std::vector<Vec3> normals = octahedron_normals();
    normals.push_back(normalized({0.123, 0.4, 1}));
    const auto all = [&] {
        const AccessSweep sweep(piece.pieces[0].piece, piece.judged(), 60);
        std::vector<std::vector<PlaneAccess>> result(normals.size());
        parallel_for(0, normals.size(),
                     [&](std::size_t i) { result[i] = sweep.sweep(normals[i], piece.offsets(normals[i], 40)); });
        std::vector<std::tuple<std::int32_t, double, double, double, double>> flat;
        for (const auto& planes : result) {
            for (const PlaneAccess& access : planes) {
                for (const bool above : {true, false}) {
                    for (const SideOnBase& s : side(access, above)) {
                        flat.emplace_back(s.cut, s.unreachable_mm2, s.caps_mm2, s.base_mm2, s.projected_mm2);
                    }
                }
            }
        }
        return flat;
    };
    const auto expected = all();
    EXPECT_GT(expected.size(), 2 * 40 * normals.size());
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(all(), expected) << threads;
    }
}

}  // namespace
}  // namespace qchopper
