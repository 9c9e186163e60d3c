#include "segment/access/accessibility.h"

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <string>

#include "base/parallel.h"
#include "segment/sample/sample.h"
#include "tests/segment/access/sampled_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::array<double, 4> tilts{0, 30, 60, 90};

// Of rays, and of states: a sample open along no, or some, direction within a tilt of an up.
struct Comparison {
    std::size_t rays = 0;
    std::size_t wrong_rays = 0;       // of samples that lie on no plane of their piece
    std::size_t rays_on_a_plane = 0;  // wrong ones of those that do
    std::size_t states = 0;
    std::size_t wrong_states = 0;
    void operator+=(const Comparison& c) {
        rays += c.rays;
        wrong_rays += c.wrong_rays;
        rays_on_a_plane += c.rays_on_a_plane;
        states += c.states;
        wrong_states += c.wrong_states;
    }
};

std::ostream& operator<<(std::ostream& out, const Comparison& c) {
    return out << c.rays << " rays, " << c.wrong_rays << " wrong, " << c.rays_on_a_plane
               << " wrong of samples on a plane; " << c.states << " states, " << c.wrong_states << " wrong";
}

Comparison compare(const SampledScan& scan, const TrackedPiece& piece) {
    Comparison result;
    const CutPieceReference reference(scan, piece);
    std::vector<Vec3> ups{{0, 0, 1}};
    for (const HalfSpace& half_space : piece.piece.half_spaces) ups.push_back(half_space.up());
    const std::size_t directions = scan.directions.size();
    for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
        std::vector<bool> is_open(directions);
        for (std::size_t k = 0; k < directions; ++k) {
            const bool expected = piece.accessibility.is_open(row, k);
            is_open[k] = reference.is_open(row, scan.directions[k], expected);
            ++result.rays;
            if (is_open[k] == expected) continue;
            ++(reference.lies_on_a_plane(row) ? result.rays_on_a_plane : result.wrong_rays);
        }
        for (const Vec3& up : ups) {
            for (const double tilt : tilts) {
                const std::vector<std::uint32_t> allowed = allowed_directions(scan.directions, up, tilt);
                const auto in_table = [&](std::uint32_t k) { return piece.accessibility.is_open(row, k); };
                const auto really = [&](std::uint32_t k) { return static_cast<bool>(is_open[k]); };
                ++result.states;
                if (std::any_of(allowed.begin(), allowed.end(), in_table) !=
                    std::any_of(allowed.begin(), allowed.end(), really))
                    ++result.wrong_states;
            }
        }
    }
    return result;
}

// At most a thousandth, and no ray of a sample that lies on no plane by more than a few grazing ones.
void expect_equal(const Comparison& c, const std::string& what) {
    std::cout << what << ": " << c << std::endl;
    EXPECT_GT(c.rays, 0U) << what;
    EXPECT_LE(1'000'000 * c.wrong_rays, 5 * c.rays) << what;
    EXPECT_LE(1'000 * c.rays_on_a_plane, c.rays) << what;
    EXPECT_LE(1'000 * c.wrong_states, c.states) << what;
}

struct Cuts {
    Comparison two_solids;
    Comparison more;
};

// Cuts random pieces of a scan, and compares the pieces that every cut makes.
Cuts compare_cuts(const TriangleMesh& mesh, std::size_t samples, int cuts, std::mt19937& random) {
    Cuts result;
    const SampledScan scan = sampled(mesh, samples);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    for (const TrackedPiece& piece : pieces) result.two_solids += compare(scan, piece);
    std::uniform_real_distribution<double> share(0.1, 0.9);
    for (std::int32_t number = 1; number <= cuts; ++number) {
        const Vec3 normal = number % 3 == 0 ? canonical({scan.directions[random() % scan.directions.size()], 0}).normal
                                            : random_normal(random);
        const std::size_t made = cut_at(scan, pieces, random() % pieces.size(), normal, share(random), number);
        for (std::size_t k = 0; k < made; ++k) {
            (made == 2 ? result.two_solids : result.more) += compare(scan, pieces[pieces.size() - 1 - k]);
        }
    }
    return result;
}

TEST(Accessibility, EqualsRaysCastOnReallyCutPiecesOfEveryShape) {
    std::mt19937 random(11);
    Cuts all;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        for (int round = 0; round < 6; ++round) {
            const Cuts of_shape = compare_cuts(mesh, 150, 3, random);
            all.two_solids += of_shape.two_solids;
            all.more += of_shape.more;
        }
    }
    expect_equal(all.two_solids, "shapes, cuts to two solids");
    expect_equal(all.more, "shapes, cuts to more");
}

TEST(Accessibility, EqualsRaysCastOnReallyCutPiecesOfABone) {
    std::mt19937 random(12);
    SampleOptions options;
    options.faces = 20'000;
    const Cuts cuts = compare_cuts(sample(Specimen::vertebra, options), 1'000, 7, random);
    expect_equal(cuts.two_solids, "vertebra, cuts to two solids");
    expect_equal(cuts.more, "vertebra, cuts to more");
}

// The second cut leaves one arc of a half torus, and its two feet.
TEST(Accessibility, AfterAFullRecastSeveralSolidsOnOneSideDoNotBlockEachOther) {
    TriangleMesh mesh = shapes::torus({0, 0, 0}, 40, 12);
    const SampledScan scan = sampled(mesh, 2'000);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    const PieceAccessibility whole = pieces[0].accessibility;
    ASSERT_EQ(cut_at(scan, pieces, 0, {1, 0, 0}, 0.5, 1), 2U);
    ASSERT_EQ(cut_at(scan, pieces, 0, {1, 0, 0}, 0.3, 2), 3U);
    ASSERT_EQ(pieces.size(), 4U);
    Comparison all;
    std::size_t open_before = 0;
    std::size_t open_now = 0;
    for (const TrackedPiece& piece : pieces) {
        all += compare(scan, piece);
        for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
            for (std::size_t k = 0; k < scan.directions.size(); ++k) {
                open_before += whole.is_open(piece.accessibility.sample[row], k) ? 1 : 0;
                open_now += piece.accessibility.is_open(row, k) ? 1 : 0;
            }
        }
    }
    expect_equal(all, "torus in four");
    EXPECT_GT(open_now, open_before + 1'000);
}

// Distances are stored in single precision: from 1e-9 to 1e-6 of the extent beside a flat region they cannot tell on
// which side of the plane a hit lies.
TEST(Accessibility, EqualsRaysCastAfterCutsFlushWithFlatRegions) {
    Comparison all;
    for (const auto& mesh : {shapes::stairs(), shapes::nested(), shapes::rotated(shapes::nested(), {1, 2, 3}, 0.4)}) {
        const SampledScan scan = sampled(mesh, 300);
        const double extent = scan.diagonal_mm;
        for (std::uint32_t i = 0; i < 12; ++i) {
            const std::size_t t = i * (mesh.triangles.size() / 12);
            const Plane flat = canonical(
                {normalized(area_vector(mesh, t)), dot(normalized(area_vector(mesh, t)), corners_of(mesh, t)[0])});
            for (const double beside : {-1e-6, -3e-8, -1e-9, 1e-9, 3e-8, 1e-6}) {
                std::vector<TrackedPiece> pieces = uncut_pieces(scan);
                cut_along(scan, pieces, 0, {flat.normal, flat.offset + beside * extent}, 1);
                for (const TrackedPiece& piece : pieces) {
                    if (!piece.piece.half_spaces.empty()) all += compare(scan, piece);
                }
            }
        }
    }
    expect_equal(all, "flush planes");
}

TEST(Accessibility, OfADirectionBesideTheOthersIsCastOnThePiece) {
    std::mt19937 random(13);
    std::size_t wrong = 0;
    std::size_t open = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const SampledScan scan = sampled(mesh, 200);
        std::vector<TrackedPiece> pieces = uncut_pieces(scan);
        for (std::int32_t number = 1; number <= 3; ++number)
            cut_at(scan, pieces, 0, random_normal(random), 0.45, number);
        for (const TrackedPiece& piece : pieces) {
            const PieceRays rays(scan, piece.accessibility);
            const CutPieceReference reference(scan, piece);
            for (int i = 0; i < 10; ++i) {
                const Vec3 direction = (i % 2 == 0 ? 1 : -1) * random_normal(random);
                const std::vector<float> distances = rays.distances(direction);
                for (std::size_t row = 0; row < distances.size(); ++row) {
                    const bool expected = std::isinf(distances[row]);
                    open += expected ? 1 : 0;
                    if (reference.is_open(row, direction, expected) != expected && !reference.lies_on_a_plane(row))
                        ++wrong;
                }
            }
        }
    }
    EXPECT_GT(open, 1'000U);
    EXPECT_EQ(wrong, 0U);
}

TEST(Accessibility, DistancesAreThoseToTheFirstSurface) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const SampledScan scan = sampled(mesh, 60);
        for (const TrackedPiece& piece : uncut_pieces(scan)) {
            for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
                const SurfaceSample& sample = scan.samples.sample[piece.accessibility.sample[row]];
                for (std::size_t k = row % 7; k < scan.directions.size(); k += 7) {
                    const float distance = piece.accessibility.distances(row)[k];
                    if (dot(sample.normal, scan.directions[k]) < min_facing) {
                        EXPECT_EQ(distance, 0) << name;
                        continue;
                    }
                    const double expected =
                        brute_force_distance(*piece.piece.mesh, origin_of(scan, sample), scan.directions[k]);
                    EXPECT_EQ(std::isinf(distance), std::isinf(expected)) << name;
                    if (!std::isinf(expected)) {
                        EXPECT_NEAR(distance, expected, 1e-6 * expected) << name;
                    }
                }
            }
        }
    }
}

TEST(Accessibility, AnotherSolidDoesNotBlock) {
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}), shapes::box({-50, -50, 11}, {50, 50, 20})});
    const SampledScan scan = sampled(mesh, 4'000);
    for (const TrackedPiece& piece : uncut_pieces(scan)) {
        for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
            const Vec3 normal = scan.samples.sample[piece.accessibility.sample[row]].normal;
            EXPECT_TRUE(piece.accessibility.is_open(row, index_of(scan.directions, normal)));
        }
    }
}

// Rays that begin inside the material of a solid that intersects itself.
TEST(Accessibility, ARayThatMeetsABackFaceFirstIsBlockedAtOnce) {
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}), shapes::box({5, 2, 2}, {15, 8, 8})});
    SampledScanOptions options;
    options.samples = 2'000;
    const SampledScan scan = sampled_scan(std::array{piece_of(mesh)},
                                          tool_directions({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}), options);
    const PieceAccessibility piece = uncut_accessibility(scan)[0];
    std::size_t inside = 0;
    for (std::size_t row = 0; row < piece.sample.size(); ++row) {
        const SurfaceSample& sample = scan.samples.sample[piece.sample[row]];
        if (sample.triangle < 12 || sample.point.x > 9.9) continue;
        ++inside;
        for (const float distance : piece.distances(row)) EXPECT_EQ(distance, 0);
    }
    EXPECT_GT(inside, 50U);
}

std::vector<float> all_distances(const TriangleMesh& mesh, PreciseRays::Instructions instructions) {
    const SampledScan scan = sampled(mesh, 2'000, instructions);
    std::vector<TrackedPiece> pieces = uncut_pieces(scan);
    cut_at(scan, pieces, 0, canonical({normalized({1, 2, -0.3}), 0}).normal, 0.45, 1);
    cut_at(scan, pieces, 0, {0, 0, 1}, 0.5, 2);
    std::vector<float> all;
    for (const TrackedPiece& piece : pieces) {
        all.insert(all.end(), piece.accessibility.distance.begin(), piece.accessibility.distance.end());
    }
    return all;
}

TEST(Accessibility, IsTheSameForAnyNumberOfThreadsAndEitherInstructionSet) {
    SampleOptions options;
    options.faces = 20'000;
    for (const TriangleMesh& mesh : {sample(Specimen::skull, options), shapes::nested()}) {
        const std::vector<float> expected = all_distances(mesh, PreciseRays::Instructions::widest);
        EXPECT_GT(expected.size(), 500'000U);
        EXPECT_EQ(all_distances(mesh, PreciseRays::Instructions::sse), expected);
        for (const std::size_t threads : {1U, 2U, 5U}) {
            const ThreadLimit limit(threads);
            EXPECT_EQ(all_distances(mesh, PreciseRays::Instructions::widest), expected) << threads;
        }
    }
}

}  // namespace
}  // namespace qchopper
