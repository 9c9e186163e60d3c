#include "segment/mesh/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Rays, MeetTheFirstSurfaceFromEitherSide) {
    const RayTree tree(shapes::box({0, 0, 0}, {10, 10, 10}));
    EXPECT_NEAR(tree.first_hit({5, 5, -7}, {0, 0, 1})->distance, 7, 1e-5);
    EXPECT_NEAR(tree.first_hit({5, 4, 3}, {0, 0, 1})->distance, 7, 1e-5);
    EXPECT_FALSE(tree.first_hit({5, 5, -7}, {0, 0, -1}).has_value());
    EXPECT_TRUE(tree.meets({5, 5, -7}, {0, 0, 1}));
    EXPECT_FALSE(tree.meets({5, 5, -7}, {0, 0, -1}));
}

TEST(Rays, FarFromTheOriginAHundredthOfAMillimetreIsResolved) {
    const RayTree tree(shapes::moved(shapes::box({0, 0, 0}, {10, 10, 10}), {1e6, 1e6, 1e6}));
    EXPECT_NEAR(tree.first_hit({1e6 + 5, 1e6 + 4, 1e6 - 7.01}, {0, 0, 1})->distance, 7.01, 1e-5);
}

// Half a million triangles and more are several trees.
TEST(Rays, AreTheSameInPacketsAndNameTrianglesOfTheWholeMesh) {
    const TriangleMesh ball = shapes::ball({100, 200, -300}, 50, 600);
    ASSERT_GT(ball.triangles.size(), std::size_t{1} << 19);
    const RayTree tree(ball);
    const Vec3 up = normalized({0.1, 0.2, 1});
    std::vector<Vec3> origins;
    for (std::size_t t = 0; t < ball.triangles.size(); t += 5'003) {
        const auto& v = ball.triangles[t];
        const Vec3 middle = (1.0 / 3) * (ball.points[v[0]] + ball.points[v[1]] + ball.points[v[2]]);
        const Vec3 outward = normalized(middle - Vec3{100, 200, -300});
        const auto hit = tree.first_hit(middle + outward, -outward);
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(hit->distance, 1, 1e-3);
        const auto& found = ball.triangles[hit->triangle];
        EXPECT_LT(norm(ball.points[found[0]] - middle), 2) << t;
        origins.push_back(middle + 0.1 * outward);
        origins.push_back(middle - 0.1 * outward);
    }
    origins.push_back({100, 200, 0});
    ASSERT_EQ(origins.size() % 8, 1U);  // the last packet is not full
    std::vector<std::uint8_t> is_met(origins.size(), 2);
    tree.meets(origins, up, is_met);
    for (std::size_t i = 0; i < origins.size(); ++i) EXPECT_EQ(is_met[i], tree.meets(origins[i], up) ? 1 : 0) << i;
    EXPECT_NE(std::count(is_met.begin(), is_met.end(), 0), 0);
}

// All meshes at their places, joined.
TriangleMesh joined(std::span<const TriangleMesh* const> meshes, std::span<const Vec3> shifts) {
    TriangleMesh all;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        for (const Vec3 p : meshes[i]->points) all.points.push_back(p + shifts[i]);
        for (const Triangle& t : meshes[i]->triangles) {
            all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
    }
    return all;
}

TEST(RayScene, MeetsWhatATreeOfAllMeshesMeetsWhereverTheyArePlaced) {
    const TriangleMesh box = shapes::box({-5, -5, -5}, {5, 5, 5});
    const TriangleMesh ball = shapes::ball({100, 0, 0}, 8, 20);
    const TriangleMesh empty;
    const std::vector<const TriangleMesh*> meshes{&box, &empty, &ball};
    RayScene scene(meshes);
    for (const std::vector<Vec3>& shifts :
         {std::vector<Vec3>{{}, {}, {}}, std::vector<Vec3>{{1e5, 3, 0}, {}, {1e5 - 85, 0, 1}}}) {
        scene.place(shifts);
        const RayTree tree(joined(meshes, shifts));
        std::vector<Vec3> directions;
        for (int i = 0; i < 8; ++i)
            directions.push_back(normalized({std::cos(0.8 * i), std::sin(0.8 * i), 0.3 * i - 1}));
        for (int i = 0; i < 200; ++i) {
            const Vec3 from = shifts[0] + Vec3{0.9 * i - 60, 11, 0.1 * i - 9};
            std::array<float, 8> distance{};
            scene.distances(from, directions, 150, distance);
            for (std::size_t k = 0; k < directions.size(); ++k) {
                const auto hit = tree.first_hit(from, directions[k]);
                EXPECT_NEAR(distance[k], hit ? std::min(hit->distance, 150.0) : 150, 2e-2) << i << " " << k;
            }
        }
    }
}

TEST(RayScene, TakesFewerRaysThanAPacketHolds) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    const std::vector<const TriangleMesh*> meshes{&box};
    const RayScene scene(meshes);
    const std::vector<Vec3> directions{{0, 0, 1}, {0, 0, -1}};
    std::array<float, 2> distance{};
    scene.distances({5, 4, -7}, directions, 100, distance);
    EXPECT_NEAR(distance[0], 7, 1e-5);
    EXPECT_EQ(distance[1], 100);
}

}  // namespace
}  // namespace qchopper
