#include "segment/raster/projected_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(ProjectedArea, LeavesHolesOut) {
    const TriangleMesh torus = shapes::torus({5, 5, 5}, 10, 3, 96);
    const double ring = std::numbers::pi * (13 * 13 - 7 * 7);
    EXPECT_NEAR(projected_area_mm2(torus, {0, 0, 1}), ring, 0.01 * ring);
    EXPECT_NEAR(projected_area_mm2(torus, {0, 0, -1}), ring, 0.01 * ring);
    const double edge_on = 6 * 20 + std::numbers::pi * 9;
    EXPECT_NEAR(projected_area_mm2(torus, {1, 0, 0}), edge_on, 0.01 * edge_on);
}

TEST(ProjectedArea, OfABoxFromAnySide) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {3, 40, 700});
    std::mt19937 random(5);
    std::normal_distribution<double> gauss;
    for (int round = 0; round < 30; ++round) {
        const Vec3 up = normalized({gauss(random), gauss(random), gauss(random)});
        const double wanted = std::abs(up.x) * 40 * 700 + std::abs(up.y) * 3 * 700 + std::abs(up.z) * 3 * 40;
        EXPECT_NEAR(projected_area_mm2(box, up), wanted, 0.02 * wanted);
    }
    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    flat.triangles = {{0, 1, 2}};
    EXPECT_EQ(projected_area_mm2(flat, {0, 0, 1}), 0);
}

}  // namespace
}  // namespace qchopper
