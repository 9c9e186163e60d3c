#include "segment/regions/engines/moments.h"

#include <gtest/gtest.h>

#include <cmath>

namespace qchopper {
namespace {

TEST(Moments, OfATriangleAreThoseOfManyPointsOfIt) {
    const std::array<Vec3, 3> corner{Vec3{1, 2, 3}, Vec3{4, 0, 1}, Vec3{-1, 1, 2}};
    PointMoments exact;
    exact.add_triangle(corner, 2);
    PointMoments sampled;
    constexpr int n = 400;
    const double share = 2.0 / (n * n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {  // the middles of n^2 equal triangles
            const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
            const double u = (i + third) / n;
            const int pair = j / 2;
            const double v = (pair + third) / n;
            sampled.add(corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]), share);
        }
    }
    EXPECT_NEAR(sampled.weight, exact.weight, 1e-9);
    EXPECT_NEAR(norm(sampled.centre() - exact.centre()), 0, 1e-9);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(sampled.products[k], exact.products[k], 1e-3);
}

TEST(Moments, OfAnEdgeAreThoseOfManyPointsOfIt) {
    PointMoments exact;
    exact.add_edge({1, 2, 3}, {4, -2, 3});
    PointMoments sampled;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) sampled.add(Vec3{1, 2, 3} + ((i + 0.5) / n) * Vec3{3, -4, 0}, 5.0 / n);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(sampled.products[k], exact.products[k], 1e-4);
}

TEST(Moments, AxesAreInTheOrderOfTheirSpread) {
    PointMoments moments;
    for (const double s : {-1.0, 1.0}) {
        moments.add({10 + 3 * s, 0, 0}, 1);
        moments.add({10, 2 * s, 0}, 1);
        moments.add({10, 0, s}, 1);
    }
    const PrincipalAxes axes = principal_axes(moments.covariance());
    EXPECT_NEAR(std::abs(axes.direction[0].z), 1, 1e-12);
    EXPECT_NEAR(std::abs(axes.direction[2].x), 1, 1e-12);
    EXPECT_NEAR(axes.square[0], 1.0 / 3, 1e-9);
    EXPECT_NEAR(axes.square[1], 4.0 / 3, 1e-9);
    EXPECT_NEAR(axes.square[2], 3, 1e-9);
}

}  // namespace
}  // namespace qchopper
