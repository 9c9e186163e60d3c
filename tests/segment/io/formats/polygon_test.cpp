#include "segment/io/formats/add_face.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

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

// Every choice of an ear is a search, so what has none must not be searched again and again.
TEST(Polygon, OfAThousandTangledCornersIsSplitAtOnce) {
    std::mt19937 random(5);
    std::vector<Vec3> points;
    for (int i = 0; i < 1000; ++i) {
        points.push_back({static_cast<double>(random() % 1000), static_cast<double>(random() % 1000), 0});
    }
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_EQ(split(points).triangles.size(), 998U);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Polygon, WithAHoleOnABridgeKeepsItsArea) {
    // a square with a square hole; the bridge 3-7 is walked both ways
    const TriangleMesh square{
        {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {4, 4, 0}, {6, 4, 0}, {6, 6, 0}, {4, 6, 0}}, {}, {}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 3, 7, 6, 5, 4, 7, 3};
    TriangleMesh mesh = square;
    split_polygon(mesh.points, corners, mesh.triangles);
    EXPECT_EQ(mesh.triangles.size(), 8U);
    EXPECT_NEAR(area_mm2(mesh), 96, 1e-9);
}

TEST(Polygon, WithoutAPlaneIsSplitAllTheSame) {
    EXPECT_EQ(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}}).triangles.size(), 3U);
    EXPECT_EQ(split({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).triangles.size(), 2U);
    EXPECT_EQ(split({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 2U);  // crosses itself
}

}  // namespace
}  // namespace qchopper
