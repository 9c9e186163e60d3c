#include "segment/raster/parallel_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The definition, one triangle at a time (Moeller and Trumbore, Fast, Minimum Storage Ray-Triangle Intersection, 1997).
double distance_to_exit(const TriangleMesh& mesh, Vec3 from, Vec3 direction) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& v : mesh.triangles) {
        const Vec3 a = mesh.points[v[0]];
        const Vec3 u = mesh.points[v[1]] - a;
        const Vec3 w = mesh.points[v[2]] - a;
        const Vec3 p = cross(direction, w);
        const double determinant = dot(u, p);
        if (determinant >= 0) continue;  // parallel, or entered through this triangle
        const double along_u = dot(from - a, p) / determinant;
        const Vec3 q = cross(from - a, u);
        const double along_w = dot(direction, q) / determinant;
        const double distance = dot(w, q) / determinant;
        const bool is_hit = along_u >= -1e-9 && along_w >= -1e-9 && along_u + along_w <= 1 + 1e-9;
        if (is_hit && distance >= 0) least = std::min(least, distance);
    }
    return least;
}

TEST(ParallelRays, AgreesWithTheDefinitionOnEveryShape) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::size_t compared = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        for (int round = 0; round < 4; ++round) {
            const Vec3 n = normalized({normal(random), normal(random), normal(random)});
            std::vector<RayQuery> queries;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {  // from every face inwards
                const Triangle& v = mesh.triangles[t];
                const Vec3 middle = (1.0 / 3) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
                const double along = dot(normalized(area_vector(mesh, t)), n);
                if (std::abs(along) > 0.5) queries.push_back({middle, along < 0});
            }
            const std::vector<double> distances = ray_distances(mesh, n, queries);
            for (std::size_t q = 0; q < queries.size(); ++q) {
                const double distance = distance_to_exit(mesh, queries[q].from, queries[q].up ? n : -n);
                ASSERT_TRUE(std::isfinite(distance)) << name;
                ASSERT_NEAR(distances[q], distance, 1e-3) << name << " " << q;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 5000U);
}

// Whatever a short reach leaves out of consideration, it loses nothing: also far from the origin, where coordinates in
// single precision would be coarse.
TEST(ParallelRays, AShortReachChangesNoDistanceWithinIt) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::size_t within = 0;
    std::size_t beyond = 0;
    for (const auto& [name, shape, solids] : shapes::all_closed()) {
        for (const Vec3 shift : {Vec3{}, Vec3{3e5, -2e5, 1e5}}) {
            const TriangleMesh mesh = shapes::moved(shape, shift);
            const Vec3 n = normalized({normal(random), normal(random), normal(random)});
            std::vector<RayQuery> queries;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                const Triangle& v = mesh.triangles[t];
                const Vec3 middle = (1.0 / 3) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
                const double along = dot(normalized(area_vector(mesh, t)), n);
                if (std::abs(along) > 0.3) queries.push_back({middle, along < 0});
            }
            const std::vector<double> all = ray_distances(mesh, n, queries);
            for (std::size_t q = 0; q < queries.size(); ++q) queries[q].reach = all[q] * (q % 2 == 0 ? 1 : 0.999);
            const std::vector<double> some = ray_distances(mesh, n, queries);
            for (std::size_t q = 0; q < queries.size(); ++q) {
                const bool is_within = all[q] <= queries[q].reach;
                ASSERT_EQ(some[q], is_within ? all[q] : std::numeric_limits<double>::infinity()) << name << " " << q;
                ++(is_within ? within : beyond);
            }
        }
    }
    EXPECT_GT(within, 1000U);
    EXPECT_GT(beyond, 1000U);
}

TEST(ParallelRays, ThroughEdgesAndVerticesOfAGridTheBoxIsNeverMissed) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 5);
    std::vector<RayQuery> queries;
    for (int i = 1; i < 20; ++i) {
        for (int j = 1; j < 20; ++j) queries.push_back({{0.5 * i, 0.5 * j, 4}, (i + j) % 2 == 0, 6});
    }
    const std::vector<double> distances = ray_distances(box, {0, 0, 1}, queries);
    for (std::size_t q = 0; q < queries.size(); ++q) EXPECT_DOUBLE_EQ(distances[q], queries[q].up ? 6 : 4) << q;
}

TEST(ParallelRays, StopsAtACavityAndMeetsNothingOutside) {
    const TriangleMesh mesh = shapes::nested();
    std::vector<RayQuery> queries{{{50, 50, 95}, false, 20}, {{50, 50, 110}, true, 20}, {{150, 50, 50}, false, 20}};
    const std::vector<double> distances = ray_distances(mesh, {0, 0, 1}, queries);
    EXPECT_DOUBLE_EQ(distances[0], 15);
    EXPECT_TRUE(std::isinf(distances[1]));
    EXPECT_TRUE(std::isinf(distances[2]));
    queries[0].reach = 14.9;
    EXPECT_TRUE(std::isinf(ray_distances(mesh, {0, 0, 1}, queries)[0]));
    EXPECT_TRUE(ray_distances(mesh, {0, 0, 1}, {}).empty());
}

}  // namespace
}  // namespace qchopper
