#include "segment/access/piece_access.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/import/import_scan.h"
#include "segment/raster/projected_area.h"
#include "segment/sample/sample.h"
#include "tests/pieces.h"
#include "tests/real_scans.h"
#include "tests/segment/objectives/extruded.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<Piece> cut_in_two(const Piece& piece, Vec3 normal, double share, std::int32_t number = 1) {
    const Extent range = extent(*piece.mesh, normal);
    const auto nudged = nudge(piece, normal, std::array{range.low + share * range.size()});
    const auto made = nudged[0] ? cut_piece(piece, {normal, nudged[0]->offset}, number) : std::nullopt;
    return made ? made->pieces : std::vector<Piece>();
}

PieceAccessOptions options_of(double tilt_deg, std::size_t samples = 1'000) {
    PieceAccessOptions options;
    options.tilt_deg = tilt_deg;
    options.samples = samples;
    return options;
}

TEST(PieceAccess, ACutCubeLiesOnItsCapAndIsReachedWhole) {
    for (const auto& [normal, turn] : {std::pair{Vec3{0, 0, 1}, 0.0}, std::pair{Vec3{1, 0, 0}, 0.7}}) {
        const TriangleMesh cube = shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}, 4), {1, 0, 0}, turn);
        const std::vector<Piece> pieces = cut_in_two(piece_of(cube), normal, 0.5);
        ASSERT_EQ(pieces.size(), 2U);
        for (const Piece& piece : pieces) {
            const std::vector<PieceBase> bases = bases_of(piece);
            ASSERT_EQ(bases.size(), 1U);
            EXPECT_EQ(bases[0].number, 1);
            EXPECT_EQ(bases[0].base.cut, 1);
            EXPECT_EQ(bases[0].base.up, piece.half_spaces[0].up());
            EXPECT_NEAR(bases[0].base_mm2, 1'600, 1e-6);
            EXPECT_NEAR(bases[0].projected_mm2, 1'600, 0.1);  // projected_area.h
            const PieceAccess access = piece_access(piece, bases, options_of(60));
            ASSERT_EQ(access.bases.size(), 1U);
            EXPECT_EQ(access.best().share(), 0);
            EXPECT_NEAR(access.best().area_mm2, 1'600 + 4 * 800, 1e-3);
            EXPECT_FALSE(access.best().directions.further.has_value());
            EXPECT_LE(access.best().directions.chosen.size(), 5U);  // up and one per wall, or fewer
            for (const SurfaceSample& s : access.samples->scan->samples.sample) {
                EXPECT_EQ(cap_of(*piece.mesh, s.triangle), no_cap);
            }
        }
    }
}

// Depth 30 along x, height 10 along z, as in unreachable_test.cpp.
TEST(PieceAccess, AHorizontalSlotIsReachedAsFarAsItsDirectionsSee) {
    const Piece slot =
        piece_of(extruded({{0, 0}, {50, 0}, {50, 10}, {20, 10}, {20, 20}, {50, 20}, {50, 30}, {0, 30}}, -3'000, 3'000));
    PieceBase below;
    below.base.up = {0, 0, 1};
    for (const double tilt : {45.0, 60.0, 70.0}) {
        for (const std::size_t most : {1U, 2U, 4U, 300U}) {
            PieceAccessOptions options = options_of(tilt, 4'000);
            options.directions = {most, 0};
            const PieceAccess access = piece_access(slot, {&below, 1}, options);
            const auto seen_along = [](const auto& directions) {
                double steepest = 0;
                for (const auto& d : directions) steepest = std::max(steepest, d.x / d.z);
                return std::min(1.0, steepest / 3);
            };
            std::vector<Vec3> chosen;
            for (const ChosenDirection& d : access.best().directions.chosen) chosen.push_back(d.direction);
            std::size_t all = 0;
            std::size_t open = 0;
            for (std::size_t row = 0; row < access.best().directions.samples.size(); ++row) {
                const SurfaceSample& s = access.samples->judged().sample(row);
                if (s.normal.z < 0.9 || std::abs(s.point.z - 10) > 1e-6 || std::abs(s.point.y) > 2'500) continue;
                ++all;
                open += access.best().directions.samples[row] == SampleAccess::reached ? 1 : 0;
            }
            ASSERT_GT(all, 400U);
            const double found = static_cast<double>(open) / static_cast<double>(all);
            EXPECT_NEAR(found, seen_along(chosen), 0.03) << tilt << " " << most;
            if (most < 300) continue;
            std::vector<Vec3> allowed;
            for (const std::uint32_t k : allowed_directions(access.samples->scan->directions, below.base.up, tilt)) {
                allowed.push_back(access.samples->scan->directions[k]);
            }
            EXPECT_NEAR(seen_along(chosen), seen_along(allowed), 1e-9) << tilt;
            if (tilt > 45) {  // one of the directions leans by 45 degrees, none by 60 or 70
                EXPECT_GT(access.best().directions.by_chosen.hidden_mm2, access.best().directions.by_all.hidden_mm2);
            }
        }
    }
}

TEST(PieceAccess, ASmallCapIsNoBaseAndThenTheSidesOfTheBoxAre) {
    const std::vector<Piece> pieces = cut_in_two(piece_of(shapes::pyramid({0, 0, 0}, 20, 50)), {0, 0, 1}, 0.9);
    ASSERT_EQ(pieces.size(), 2U);
    const std::vector<PieceBase> of_tip = bases_of(pieces[0]);
    ASSERT_EQ(of_tip.size(), 1U);
    EXPECT_EQ(of_tip[0].number, 1);
    const std::vector<PieceBase> of_stump = bases_of(pieces[1]);
    ASSERT_EQ(of_stump.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(of_stump[i].number, static_cast<int>(i) + 1);
        EXPECT_FALSE(of_stump[i].base.cut.has_value());
        EXPECT_EQ(of_stump[i].base_mm2, 0);
        EXPECT_NEAR(of_stump[i].projected_mm2, projected_area_mm2(*pieces[1].mesh, of_stump[i].base.up), 1e-9);
        if (i % 2 == 1) {
            EXPECT_EQ(of_stump[i].base.up, -of_stump[i - 1].base.up);
        }
    }
    const auto tall = [&](std::size_t i) { return extent(*pieces[1].mesh, of_stump[i].base.up).size(); };
    EXPECT_LE(tall(0), tall(2) + 1e-6);
    EXPECT_LE(tall(2), tall(4) + 1e-6);
    const PieceAccess access = piece_access(pieces[1], of_stump, options_of(60));
    ASSERT_EQ(access.bases.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(access.bases[i].base.number, of_stump[i].number);
        EXPECT_LE(access.best().share(), access.bases[i].share());
    }
}

TEST(PieceAccess, EveryCapOfATenthIsABaseWhateverItsCut) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        if (solids != 1) continue;
        for (const Piece& half : cut_in_two(piece_of(mesh), normalized({1, 2, 3}), 0.4, 3)) {
            for (const Piece& piece : cut_in_two(half, {1, 0, 0}, 0.55, 7)) {
                std::vector<PieceBase> expected;
                for (const OwnedCap& cap : owned_caps(piece)) {
                    const double projected = projected_area_mm2(*piece.mesh, -cap.outward);
                    if (cap.area_mm2 < 0.1 * projected) continue;
                    PieceBase base;
                    base.number = cap.cut;
                    base.base_mm2 = cap.area_mm2;
                    expected.push_back(base);
                }
                const std::vector<PieceBase> found = bases_of(piece);
                if (expected.empty()) {
                    EXPECT_EQ(found.size(), 6U) << name;
                    continue;
                }
                ASSERT_EQ(found.size(), expected.size()) << name;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    EXPECT_EQ(found[i].number, expected[i].number) << name;
                    EXPECT_EQ(found[i].base_mm2, expected[i].base_mm2) << name;
                    EXPECT_EQ(found[i].base.cut, found[i].number) << name;
                }
            }
        }
    }
}

Piece half_vertebra(std::size_t faces) {
    SampleOptions options;
    options.faces = faces;
    return cut_in_two(piece_of(sample(Specimen::vertebra, options)), {0, 0, 1}, 0.5)[0];
}

TEST(PieceAccess, WhereOnlyUpIsHeldTheToolDoesNotTilt) {
    const Piece piece = half_vertebra(10'000);
    const std::vector<PieceBase> bases = bases_of(piece);
    const ReachableDirections only_up = [](const PieceBase& base, std::span<const Vec3> directions) {
        std::vector<std::uint8_t> is_held;
        for (const Vec3& d : directions) is_held.push_back(d == base.base.up ? 1 : 0);
        return is_held;
    };
    const PieceAccess held = piece_access(piece, bases, options_of(60, 500), only_up);
    const PieceAccess straight = piece_access(piece, bases, options_of(0, 500));
    ASSERT_EQ(held.bases.size(), straight.bases.size());
    for (std::size_t i = 0; i < held.bases.size(); ++i) {
        const ChosenDirections& a = held.bases[i].directions;
        const ChosenDirections& b = straight.bases[i].directions;
        ASSERT_EQ(a.chosen.size(), 1U);
        ASSERT_EQ(b.chosen.size(), 1U);
        EXPECT_EQ(a.chosen[0].direction, bases[i].base.up);
        EXPECT_EQ(a.samples, b.samples);
        for (const UnreachableArea& area : {a.by_chosen, a.by_all}) {
            EXPECT_EQ(area.hidden_mm2, b.by_chosen.hidden_mm2);
            EXPECT_EQ(area.steep_mm2, b.by_chosen.steep_mm2);
            EXPECT_EQ(area.caps_mm2, b.by_chosen.caps_mm2);
        }
        EXPECT_GT(a.by_chosen.steep_mm2, 0);
        EXPECT_NEAR(held.bases[i].unreachable_mm2 - straight.bases[i].unreachable_mm2, a.by_chosen.steep_mm2, 1e-9);
    }
}

TEST(PieceAccess, OnlyHeldDirectionsWithinTheTiltAreTaken) {
    const Piece piece = half_vertebra(10'000);
    const std::vector<PieceBase> bases = bases_of(piece);
    const ReachableDirections to_one_side = [](const PieceBase& base, std::span<const Vec3> directions) {
        std::vector<std::uint8_t> is_held;
        for (const Vec3& d : directions) {
            EXPECT_TRUE(is_allowed(d, base.base.up, 50));
            is_held.push_back(d.x >= 0 ? 1 : 0);
        }
        return is_held;
    };
    const PieceAccess all = piece_access(piece, bases, options_of(50, 500));
    const PieceAccess some = piece_access(piece, bases, options_of(50, 500), to_one_side);
    for (std::size_t i = 0; i < bases.size(); ++i) {
        const ChosenDirections& chosen = some.bases[i].directions;
        EXPECT_GT(chosen.chosen.size(), 1U);
        for (std::size_t k = 1; k < chosen.chosen.size(); ++k) EXPECT_GE(chosen.chosen[k].direction.x, 0);
        if (chosen.further) {
            EXPECT_GE(chosen.further->direction.x, 0);
        }
        EXPECT_GE(chosen.by_all.total_mm2(50), all.bases[i].directions.by_all.total_mm2(50));
        EXPECT_GE(some.bases[i].share(), 0);
        EXPECT_LE(some.bases[i].share(), 1);
    }
}

auto bytes_of(const PieceAccess& access) {
    std::vector<double> numbers;
    std::vector<SampleAccess> samples;
    for (const BaseAccess& b : access.bases) {
        std::vector<ChosenDirection> directions = b.directions.chosen;
        if (b.directions.further) directions.push_back(*b.directions.further);
        for (const ChosenDirection& d : directions) {
            for (const double v : {d.direction.x, d.direction.y, d.direction.z, d.gained_mm2}) numbers.push_back(v);
        }
        for (const UnreachableArea& a : {b.directions.by_chosen, b.directions.by_all}) {
            for (const double v : {a.hidden_mm2, a.steep_mm2, a.caps_mm2}) numbers.push_back(v);
        }
        for (const double v : {b.area_mm2, b.unreachable_mm2}) numbers.push_back(v);
        samples.insert(samples.end(), b.directions.samples.begin(), b.directions.samples.end());
    }
    return std::tuple(numbers, samples, access.samples->accessibility.distance);
}

TEST(PieceAccess, IsTheSameForAnyNumberOfThreads) {
    const Piece piece = half_vertebra(10'000);
    const std::vector<PieceBase> bases = bases_of(piece);
    const auto expected = bytes_of(piece_access(piece, bases, options_of(45, 300)));
    EXPECT_GT(std::get<2>(expected).size(), 10'000U);
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(bytes_of(piece_access(piece, bases, options_of(45, 300))), expected) << threads;
    }
}

TEST(PieceAccess, MoreTiltNeverLeavesMoreOfARealScan) {
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    std::size_t taken = 0;
    for (const RealScan& real : valid_scans(QCHOPPER_MESHES, 30'000)) {
        ImportOptions import;
        import.mm_per_unit = 1;
        const TriangleMesh mesh = import_scan(std::filesystem::path(QCHOPPER_MESHES) / real.file, import).mesh;
        for (const Piece& piece : cut_in_two(piece_of(mesh), {0, 0, 1}, 0.5)) {
            const std::vector<PieceBase> bases = bases_of(piece);
            std::vector<double> before(bases.size(), std::numeric_limits<double>::infinity());
            for (const double tilt : {0.0, 30.0, 60.0}) {
                PieceAccessOptions options = options_of(tilt, 300);
                const PieceAccess access = piece_access(piece, bases, options);
                for (std::size_t i = 0; i < bases.size(); ++i) {
                    const ChosenDirections& d = access.bases[i].directions;
                    double gained = 0;
                    for (const ChosenDirection& c : d.chosen) gained += c.gained_mm2;
                    const double area = access.bases[i].area_mm2;
                    EXPECT_NEAR(gained + d.by_chosen.total_mm2(90), area, 1e-9 * area) << real.file;
                    EXPECT_LE(d.by_all.total_mm2(90), d.by_chosen.total_mm2(90) + 1e-9 * area) << real.file;
                    EXPECT_LE(d.by_all.total_mm2(90), before[i] + 1e-9 * area) << real.file;
                    before[i] = d.by_all.total_mm2(90);
                    EXPECT_LE(access.best().share(), access.bases[i].share());
                }
            }
            ++taken;
        }
    }
    EXPECT_GT(taken, 1U);
}

}  // namespace
}  // namespace qchopper
