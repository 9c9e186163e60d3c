#include "cam/setup/undercut.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

TEST(Undercut, OnAClosedPieceUpIsDownAndBase) {
    int bases = 0;
    for (const Piece& piece : cut_shapes()) {
        for (const HalfSpace& half_space : piece.half_spaces) {
            const Facing sums = facing(*piece.mesh, half_space.up(), half_space.cut);
            EXPECT_NEAR(sums.up, sums.down + sums.base, 1e-9 * area_mm2(*piece.mesh)) << piece.name;
            if (sums.base_triangles == 0) continue;
            ++bases;
            EXPECT_LT(sums.undercut(), 0.5);
        }
        const Facing without = facing(*piece.mesh, {0, 0, 1}, std::nullopt);
        EXPECT_NEAR(without.undercut(), 0.5, 1e-9) << "with the base counted the share is always one half";
    }
    EXPECT_GT(bases, 20);
}

// A table top on a leg: the leg and all below the top are occluded.
TEST(Undercut, WhatStandsBelowIsOccluded) {
    const TriangleMesh leg = shapes::box({1, 1, 0}, {2, 2, 1});
    const TriangleMesh top = shapes::box({0, 0, 2}, {3, 3, 3});
    const TriangleMesh both = shapes::joined({leg, top});
    const RayTree rays(both);
    EXPECT_NEAR(occluded_area_ratio(both, rays, {0, 0, 1}, std::nullopt), (6.0 + 9) / (6 + 30), 1e-9);
    EXPECT_NEAR(occluded_area_ratio(both, rays, {0, 0, -1}, std::nullopt), (1.0 + 9) / (6 + 30), 0.2);
}

TEST(Undercut, TheBaseIsNeverOccluded) {
    const Piece piece = standing_box({0, 0, 0}, {3, 4, 5}, 0, 3);
    const RayTree rays(*piece.mesh);
    EXPECT_EQ(occluded_area_ratio(*piece.mesh, rays, {0, 0, 1}, 0), 0);
    EXPECT_NEAR(occluded_area_ratio(*piece.mesh, rays, {0, 0, 1}, std::nullopt), 12.0 / 94, 1e-9);
}

TEST(Undercut, HalfOfABallIsOccluded) {
    const TriangleMesh ball = shapes::ball({100, 200, 3000}, 50, 40);
    const RayTree rays(ball);
    for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.6, 0, 0.8}}) {
        EXPECT_NEAR(occluded_area_ratio(ball, rays, up, std::nullopt), 0.5, 0.03);
    }
}

TEST(Undercut, ASampleEstimatesTheRatioWithinItsError) {
    const TriangleMesh torus = shapes::torus({30, -20, 700}, 50, 20, 160);
    const RayTree rays(torus);
    const std::vector<std::uint32_t> sample = area_sample(torus, 5'000);
    EXPECT_EQ(sample.size(), 5'000U);
    for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6, 0, 0.8}}) {
        EXPECT_NEAR(occluded_area_ratio(torus, rays, up, sample), occluded_area_ratio(torus, rays, up, std::nullopt),
                    3 * 0.5 / std::sqrt(5'000.0));
    }
}

TEST(Undercut, TrianglesStandInTheSampleAsOftenAsTheirAreaDemands) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 30});
    std::vector<double> times(box.triangles.size(), 0);
    for (const std::uint32_t t : area_sample(box, 10'000)) ++times[t];
    for (std::size_t t = 0; t < times.size(); ++t) {
        EXPECT_NEAR(times[t] / 10'000, norm(area_vector(box, t)) / area_mm2(box), 2e-4) << t;
    }
    EXPECT_TRUE(area_sample({}, 10).empty());
}

}  // namespace
}  // namespace qchopper
