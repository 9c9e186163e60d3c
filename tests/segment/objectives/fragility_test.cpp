#include "tests/reference/segment/objectives/fragility.h"

#include <gtest/gtest.h>

#include "segment/cut/cut.h"
#include "segment/cut/cut_piece.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double thinness_of(const Piece& piece, const Plane& plane, double distance) {
    return thinness(piece, plane, cut(*piece.mesh, plane, 1)->cap_area_mm2, distance);
}

TEST(Fragility, ASlabLeftOnOneSideGivesOneMinusItsThicknessWhateverItsMesh) {
    for (const int n : {1, 2, 7, 20}) {
        const TriangleMesh box = shapes::box({0, 0, 0}, {100, 100, 100}, n);
        const Piece piece = piece_of(box);
        for (const double t : {1.0, 5.5, 13.0, 19.9}) {
            EXPECT_NEAR(thinness_of(piece, {{0, 0, 1}, 100 - t}, 20), 1 - t / 20, 1e-6) << n;
            EXPECT_NEAR(thinness_of(piece, {{0, 0, 1}, t}, 20), 1 - t / 20, 1e-6) << n;
        }
        EXPECT_EQ(thinness_of(piece, {{0, 0, 1}, 50}, 20), 0) << n;
    }
}

TEST(Fragility, ASlabOfAPieceWithCapsCountsItsCaps) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {100, 100, 100}, 3);
    const auto lower = cut_piece(piece_of(box), {{0, 0, 1}, 60.0}, 1)->pieces[1];
    EXPECT_NEAR(thinness_of(lower, {{0, 0, 1}, 55}, 20), 1 - 5.0 / 20, 1e-6);
    EXPECT_NEAR(thinness_of(lower, {{0, 0, 1}, 7}, 20), 1 - 7.0 / 20, 1e-6);
}

TEST(Fragility, ABallsSkinHasTheValueOfTheIntegral) {
    // Spherical cap of height 0.05 r: integral of (1 - (r cos a - 0.95 r)/r) cos^2 a dA over the disc 0.0975 pi r^2.
    for (const int rings : {24, 60, 200}) {
        const TriangleMesh ball = shapes::ball({0, 0, 0}, 50, rings);
        EXPECT_NEAR(thinness_of(piece_of(ball), {{0, 0, 1}, 0.95 * 50}, 50), 0.9748, 0.01) << rings;
    }
}

TEST(Fragility, AWallAcrossAGapDoesNotCount) {
    // Two plates with a gap between: from the far plate's upper side the ray to the plane crosses the gap.
    const TriangleMesh plates =
        shapes::joined({shapes::box({0, 0, 0}, {50, 50, 30}, 4), shapes::box({0, 0, 32}, {50, 50, 35}, 4)});
    const Piece lower = piece_of(plates);
    EXPECT_NEAR(thinness_of(lower, {{0, 0, 1}, 28}, 20), 1 - 2.0 / 20, 1e-6);
}

TEST(Fragility, AnOldCapStopsTheRayBehindIt) {
    // A bar bent back: after the first cut only one leg belongs to the piece.
    const TriangleMesh box = shapes::box({0, 0, 0}, {40, 40, 40}, 80);
    const auto pieces = cut_piece(piece_of(box), {normalized({1, 0, 1}), 50}, 1)->pieces;
    // Above the slanting cap the corner piece's top is at 40; every parallel ray down from it at x < 30 leaves through
    // the cap before it reaches z = 31.
    const double cap = cut(*pieces[0].mesh, {{0, 0, 1}, 38.0}, 2)->cap_area_mm2;
    const double all = thinness(pieces[0], {{0, 0, 1}, 38.0}, cap, 20);
    const double top_over_cap = 40 * (40 - (50 * std::sqrt(2.0) - 38));  // its part right above the section
    EXPECT_NEAR(all * cap, top_over_cap * (1 - 2.0 / 20), 0.04 * top_over_cap);
}

TEST(Fragility, TheThesisFormIsTheSumThatItPrints) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 2);
    // Top: the centre vertex's normal is +z, the edges' and corners' normals slant too far. Distance 2.
    EXPECT_NEAR(thesis_fragility(piece_of(box), {{0, 0, 1}, 8}, 5), 2, 1e-9);
    EXPECT_NEAR(thesis_fragility(piece_of(box), {{0, 0, 1}, 5}, 6), 5 + 5, 1e-9);
}

}  // namespace
}  // namespace qchopper
