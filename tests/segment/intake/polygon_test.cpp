#include "segment/intake/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

TriangleMesh split(std::vector<Vec3> points) {
    TriangleMesh mesh;
    mesh.points = std::move(points);
    std::vector<std::uint32_t> corners(mesh.points.size());
    std::iota(corners.begin(), corners.end(), 0U);
    split_polygon(mesh.points, corners, mesh.triangles);
    return mesh;
}

// A star with n arms, turned out of every coordinate plane.
std::vector<Vec3> star(int n) {
    std::vector<Vec3> points;
    for (int i = 0; i < 2 * n; ++i) {
        const double angle = 3.14159265358979 * i / n;
        const double r = i % 2 == 0 ? 10 : 2;
        points.push_back({r * std::cos(angle), 0.6 * r * std::sin(angle), 0.8 * r * std::sin(angle)});
    }
    return points;
}

TEST(Polygon, PiecesAddUpToTheWholeAndFaceOneWay) {
    for (const int arms : {2, 3, 5, 9, 40}) {
        const TriangleMesh mesh = split(star(arms));
        EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * arms - 2));
        EXPECT_NEAR(area_mm2(mesh), 2 * arms * 0.5 * 10 * 2 * std::sin(3.14159265358979 / arms), 1e-9);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            EXPECT_GE(dot(area_vector(mesh, t), {0, -0.8, 0.6}), -1e-12);
        }
    }
}

TEST(Polygon, WithoutAPlaneIsSplitAllTheSame) {
    EXPECT_EQ(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}}).triangles.size(), 3U);
    EXPECT_EQ(split({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).triangles.size(), 2U);
    EXPECT_EQ(split({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 2U);  // crosses itself
}

}  // namespace
}  // namespace qchopper
