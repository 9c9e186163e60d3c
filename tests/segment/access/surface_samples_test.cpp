#include "segment/access/surface_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SurfaceSamples samples_of(const TriangleMesh& mesh, std::size_t count) {
    return surface_samples(std::array{SampledSurface{&mesh, {}}}, count);
}

TEST(SurfaceSamples, LieOnTheirTrianglesWithTheirNormals) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const SurfaceSamples s = samples_of(mesh, 500);
        ASSERT_EQ(s.sample.size(), 500U) << name;
        EXPECT_NEAR(500 * s.area_each_mm2, area_mm2(mesh), 1e-9 * area_mm2(mesh)) << name;
        for (const SurfaceSample& sample : s.sample) {
            const auto [a, b, c] = corners_of(mesh, sample.triangle);
            const double size = norm(b - a) + norm(c - a) + 1e-6 * norm(a);
            EXPECT_NEAR(norm(sample.normal), 1, 1e-12) << name;
            EXPECT_NEAR(dot(sample.normal, sample.point - a), 0, 1e-9 * size) << name;
            for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
                EXPECT_GE(dot(cross(q - p, sample.point - p), sample.normal), -1e-9 * size * size) << name;
            }
        }
    }
}

TEST(SurfaceSamples, EveryRunOfTrianglesHasItsShareOfThem) {
    const TriangleMesh mesh = shapes::nested();
    const SurfaceSamples s = samples_of(mesh, 3'000);
    std::vector<int> of_triangle(mesh.triangles.size());
    for (const SurfaceSample& sample : s.sample) ++of_triangle[sample.triangle];
    double area = 0;
    int count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        area += norm(area_vector(mesh, t));
        count += of_triangle[t];
        EXPECT_LE(std::abs(count - area / s.area_each_mm2), 1.001) << t;
    }
}

TEST(SurfaceSamples, AreSpreadInsideATriangle) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {30, 0, 0}, {0, 30, 0}};
    mesh.triangles = {{0, 1, 2}};
    Vec3 sum;
    const SurfaceSamples s = samples_of(mesh, 20'000);
    for (const SurfaceSample& sample : s.sample) sum = sum + sample.point;
    const Vec3 mean = (1.0 / 20'000) * sum;
    EXPECT_NEAR(mean.x, 10, 0.3);
    EXPECT_NEAR(mean.y, 10, 0.3);
}

TEST(SurfaceSamples, TrianglesWithoutAreaAndThoseLeftOutCarryNone) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    TriangleMesh mesh = box;
    mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
    mesh.triangles.push_back({3, 3, 3});
    std::vector<bool> is_left_out(mesh.triangles.size(), false);
    is_left_out[5] = true;
    const SurfaceSamples s = surface_samples(std::array{SampledSurface{&mesh, is_left_out}}, 1'000);
    ASSERT_EQ(s.sample.size(), 1'000U);
    EXPECT_NEAR(s.area_each_mm2, 0.55, 1e-12);
    for (const SurfaceSample& sample : s.sample) {
        EXPECT_NE(sample.triangle, 0U);
        EXPECT_NE(sample.triangle, 5U);
        EXPECT_NE(sample.triangle, mesh.triangles.size() - 1);
    }
    EXPECT_TRUE(surface_samples(std::array{SampledSurface{&mesh, std::vector<bool>(mesh.triangles.size(), true)}}, 9)
                    .sample.empty());
}

TEST(SurfaceSamples, AreTheSameTwiceAndSharedOutAmongSurfacesByArea) {
    const TriangleMesh small = shapes::box({0, 0, 0}, {10, 10, 10});
    const TriangleMesh large = shapes::box({50, 0, 0}, {70, 20, 20});
    const std::array<SampledSurface, 2> surfaces{SampledSurface{&small, {}}, SampledSurface{&large, {}}};
    const SurfaceSamples s = surface_samples(surfaces, 1'000);
    std::size_t on_small = 0;
    for (const SurfaceSample& sample : s.sample) on_small += sample.mesh == 0 ? 1 : 0;
    EXPECT_EQ(on_small, 200U);
    const SurfaceSamples again = surface_samples(surfaces, 1'000);
    for (std::size_t i = 0; i < 1'000; ++i) EXPECT_EQ(s.sample[i].point, again.sample[i].point);
}

}  // namespace
}  // namespace qchopper
