#include "segment/access/tool_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "base/parallel.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/sample/sample.h"
#include "tests/real_scans.h"
#include "tests/segment/objectives/extruded.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<SurfaceSample> samples_of(const TriangleMesh& mesh, std::size_t count) {
    return surface_samples(std::array{SampledSurface{&mesh, {}}}, count).sample;
}

double share(const std::vector<bool>& is_narrow) {
    return static_cast<double>(std::count(is_narrow.begin(), is_narrow.end(), true)) /
           static_cast<double>(is_narrow.size());
}

// By trying all triangles.
bool is_too_narrow(const TriangleMesh& mesh, const std::vector<bool>& is_left_out, const SurfaceSample& sample,
                   const BallFit& ball) {
    const Vec3 centre = sample.point + (ball.radius + std::max(ball.allowance, ball.lift)) * sample.normal;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_left_out.empty() && is_left_out[t]) continue;
        if (norm(closest_on_triangle(centre, corners_of(mesh, t)) - centre) < ball.radius * (1 - 1e-12)) return true;
    }
    return false;
}

TEST(ToolFit, EqualsTryingAllTriangles) {
    std::mt19937 random(51);
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const std::vector<SurfaceSample> samples = samples_of(mesh, 200);
        std::vector<bool> is_left_out;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) is_left_out.push_back(random() % 5 == 0);
        for (const BallFit& ball : {BallFit{1.3}, BallFit{7.1}, BallFit{4.3, 0.7}, BallFit{23.7, 0, 0.2}}) {
            for (const std::vector<bool>& left_out : {std::vector<bool>(), is_left_out}) {
                const std::vector<bool> found = too_narrow(mesh, left_out, samples, ball);
                ASSERT_EQ(found.size(), samples.size());
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    EXPECT_EQ(found[i], is_too_narrow(mesh, left_out, samples[i], ball)) << name << " " << i;
                }
            }
        }
    }
}

TEST(ToolFit, AnyBallFitsOnAConvexSolid) {
    for (const TriangleMesh& mesh :
         {shapes::ball({5, -3, 2}, 25, 40), shapes::box({0, 0, 0}, {40, 30, 20}, 6), shapes::pyramid({0, 0, 0}, 20, 50),
          shapes::rotated(shapes::box({0, 0, 0}, {40, 40, 40}, 8), {1, 2, 3}, 0.7)}) {
        const std::vector<SurfaceSample> samples = samples_of(mesh, 1'000);
        for (const double radius : {0.5, 3.0, 20.0, 500.0}) {
            for (const double allowance : {0.0, 1.0}) {
                EXPECT_EQ(share(too_narrow(mesh, {}, samples, {radius, allowance})), 0) << radius;
                EXPECT_EQ(share(too_narrow(mesh, {}, samples, {radius, allowance, 1e-6})), 0) << radius;
            }
        }
    }
}

TEST(ToolFit, ALargerBallNeverFitsWhereASmallerOneDoesNot) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const std::vector<SurfaceSample> samples = samples_of(mesh, 500);
        for (const double allowance : {0.0, 0.6}) {
            std::vector<bool> smaller(samples.size(), false);
            for (const double radius : {0.3, 1.1, 2.7, 5.3, 9.1, 17.0, 40.0}) {
                const std::vector<bool> now = too_narrow(mesh, {}, samples, {radius, allowance});
                for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_LE(smaller[i], now[i]) << name << " " << radius;
                smaller = now;
            }
        }
    }
}

TEST(ToolFit, InAHollowOnlySmallerBallsFit) {
    const TriangleMesh hollow = shapes::turned_inside_out(shapes::ball({1, 2, 3}, 10, 40));
    const std::vector<SurfaceSample> samples = samples_of(hollow, 1'000);
    for (const double radius : {1.0, 3.0, 6.0}) EXPECT_EQ(share(too_narrow(hollow, {}, samples, {radius})), 0);
    for (const double radius : {10.1, 12.0, 30.0}) EXPECT_EQ(share(too_narrow(hollow, {}, samples, {radius})), 1);
}

// A slot of width 10 and depth 30, open upwards: a ball that is narrower leaves only what lies within its radius of the
// edges of the floor.
constexpr double width = 10;
const std::vector<Point2> slotted{{0, 0}, {40, 0}, {40, 40}, {25, 40}, {25, 10}, {15, 10}, {15, 40}, {0, 40}};

bool lies_in_slot(const SurfaceSample& s) {
    return s.point.x > 15 - 1e-6 && s.point.x < 25 + 1e-6 && s.point.z > 10 - 1e-6 && s.point.z < 40 - 1e-6;
}

TEST(ToolFit, ASlotIsTooNarrowForAWiderBall) {
    const TriangleMesh mesh = extruded(slotted, -200, 200);
    const std::vector<SurfaceSample> samples = samples_of(mesh, 4'000);
    for (const double radius : {1.0, 2.0, 4.0, 4.9, 5.01, 6.0, 9.0}) {
        const std::vector<bool> is_narrow = too_narrow(mesh, {}, samples, {radius});
        std::size_t in_slot = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (std::abs(samples[i].point.y) > 180) continue;
            if (!lies_in_slot(samples[i])) {
                EXPECT_FALSE(is_narrow[i]) << radius;
                continue;
            }
            ++in_slot;
            const bool is_floor = samples[i].normal.z > 0.5;
            const double to_edge = is_floor ? width / 2 - std::abs(samples[i].point.x - 20) : samples[i].point.z - 10;
            // The mouth of the slot is a corner of the upper surface: a ball at its rim may pass over the other wall.
            if (!is_floor && 2 * radius > width && samples[i].point.z > 40 - radius) continue;
            if (std::abs(to_edge - radius) > 1e-6) {
                EXPECT_EQ(is_narrow[i], to_edge < radius || 2 * radius + default_lift_mm > width) << radius;
            }
        }
        EXPECT_GT(in_slot, 1'000U);
    }
}

TEST(ToolFit, TrianglesLeftOutHinderNoBall) {
    const TriangleMesh mesh = extruded(slotted, -200, 200);
    const std::vector<SurfaceSample> samples = samples_of(mesh, 2'000);
    std::vector<bool> is_floor;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 up = normalized(area_vector(mesh, t));
        is_floor.push_back(up.z > 0.5 && std::abs(corners_of(mesh, t)[0].z - 10) < 1e-6);
    }
    ASSERT_EQ(std::count(is_floor.begin(), is_floor.end(), true), 2);
    const std::vector<bool> with = too_narrow(mesh, {}, samples, {4});
    const std::vector<bool> without = too_narrow(mesh, is_floor, samples, {4});
    std::size_t freed = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_LE(without[i], with[i]);
        const bool is_wall = lies_in_slot(samples[i]) && std::abs(samples[i].normal.x) > 0.5;
        EXPECT_FALSE(is_wall && without[i]);
        freed += is_wall && with[i] ? 1 : 0;
    }
    EXPECT_GT(freed, 50U);
}

// A level square of triangles 0.5 mm long whose heights vary by 0.02 mm.
TEST(ToolFit, NoiseOfAScanIsNoNarrowPlace) {
    constexpr int n = 60;
    std::mt19937 random(52);
    std::uniform_real_distribution<double> noise(-0.01, 0.01);
    TriangleMesh mesh;
    const auto index = [](int i, int k) { return static_cast<std::uint32_t>(i * (n + 1) + k); };
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) mesh.points.push_back({0.5 * i, 0.5 * k, noise(random)});
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            mesh.triangles.push_back({index(i, k), index(i + 1, k), index(i + 1, k + 1)});
            mesh.triangles.push_back({index(i, k), index(i + 1, k + 1), index(i, k + 1)});
        }
    }
    const std::vector<SurfaceSample> samples = samples_of(mesh, 2'000);
    ASSERT_GT(samples[0].normal.z, 0.9);
    for (const double radius : {1.5, 3.0, 5.0}) {
        EXPECT_LE(share(too_narrow(mesh, {}, samples, {radius})), 0.01) << radius;
        EXPECT_GE(share(too_narrow(mesh, {}, samples, {radius, 0, 1e-6 * radius})), 0.1) << radius;
    }
}

TEST(ToolFit, IsTheSameForAnyNumberOfThreads) {
    SampleOptions options;
    options.faces = 20'000;
    const TriangleMesh mesh = sample(Specimen::vertebra, options);
    const std::vector<SurfaceSample> samples = samples_of(mesh, 3'000);
    const std::vector<bool> expected = too_narrow(mesh, {}, samples, {3});
    EXPECT_GT(share(expected), 0.01);
    EXPECT_LT(share(expected), 0.99);
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(too_narrow(mesh, {}, samples, {3}), expected) << threads;
    }
}

TEST(ToolFit, EqualsTryingAllTrianglesOfRealScans) {
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    std::size_t taken = 0;
    for (const RealScan& real : valid_scans(QCHOPPER_MESHES, 30'000)) {
        ImportOptions options;
        options.mm_per_unit = 1;
        const TriangleMesh mesh = import_scan(std::filesystem::path(QCHOPPER_MESHES) / real.file, options).mesh;
        const Box box = bounds(mesh);
        const std::vector<SurfaceSample> samples = samples_of(mesh, 100);
        for (const double radius_share : {0.01, 0.03, 0.1}) {
            const double size = norm(box.size());
            const BallFit ball{radius_share * size, 0, 1e-4 * size};
            const std::vector<bool> found = too_narrow(mesh, {}, samples, ball);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                EXPECT_EQ(found[i], is_too_narrow(mesh, {}, samples[i], ball)) << real.file;
            }
        }
        ++taken;
    }
    EXPECT_GT(taken, 0U);
}

}  // namespace
}  // namespace qchopper
