#include "segment/mesh/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

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

// Distances of PreciseRays are those of doubles; its triangles are those of the whole mesh, also in the second tree.
TEST(PreciseRays, MeetTheFirstTriangleOfTheMeshThatIsAsked) {
    const TriangleMesh ball = shapes::ball({100, 200, -300}, 50, 600);
    ASSERT_GT(ball.triangles.size(), std::size_t{1} << 19);
    const TriangleMesh box = shapes::moved(shapes::box({0, 0, 0}, {10, 10, 10}), {1e6, 1e6, 1e6});
    const TriangleMesh empty;
    const std::vector<const TriangleMesh*> meshes{&ball, &empty, &box};
    const PreciseRays rays(meshes);
    EXPECT_NEAR(rays.first_hit(2, {1e6 + 5, 1e6 + 4, 1e6 - 0.01}, {0, 0, 1})->distance, 0.01, 1e-9);
    EXPECT_NEAR(rays.first_hit(2, {1e6 + 5, 1e6 + 4, 1e6 + 3}, {0, 0, 1})->distance, 7, 1e-9);
    EXPECT_FALSE(rays.first_hit(2, {1e6 + 5, 1e6 + 4, 1e6 - 1}, {0, 0, -1}).has_value());
    EXPECT_FALSE(rays.first_hit(1, {}, {0, 0, 1}).has_value());
    for (std::size_t t = 0; t < ball.triangles.size(); t += 5'003) {
        const auto [a, b, c] = corners_of(ball, t);
        const Vec3 middle = (1.0 / 3) * (a + b + c);
        const Vec3 outward = normalized(area_vector(ball, t));
        const auto hit = rays.first_hit(0, middle + outward, -outward);
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->triangle, t);
        EXPECT_NEAR(hit->distance, 1, 1e-10);
    }
}

TEST(PreciseRays, DoNotPassBetweenTwoTrianglesOrThroughACorner) {
    for (const auto& mesh : {shapes::ball({5, -3, 2}, 25), shapes::ball({5e5, -3e5, 2e5}, 25),
                             shapes::rotated(shapes::box({-10, -20, -30}, {10, 20, 30}, 5), {1, 2, 3}, 0.3)}) {
        const PreciseRays rays(std::array{&mesh});
        Vec3 sum;
        for (const Vec3& p : mesh.points) sum = sum + p;
        const Vec3 centre = (1.0 / static_cast<double>(mesh.points.size())) * sum;
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 a = mesh.points[t[k]];
                const Vec3 b = mesh.points[t[(k + 1) % 3]];
                for (const double share : {0.0, 0.5, 0.317}) {
                    const Vec3 at = a + share * (b - a);
                    const auto hit = rays.first_hit(0, centre, normalized(at - centre));
                    ASSERT_TRUE(hit.has_value());
                    EXPECT_NEAR(hit->distance, norm(at - centre), 1e-9 * (1 + norm(centre)));
                }
            }
        }
    }
}

TEST(PreciseRays, PassThroughTrianglesWithAnotherLabel) {
    const TriangleMesh mesh = shapes::nested();
    std::vector<std::uint32_t> label(mesh.triangles.size(), 7);
    std::fill_n(label.begin(), 12 * 16, 3U);  // the outer box: 6 sides of 4 x 4 squares
    const PreciseRays rays(std::array{&mesh});
    const Vec3 from{-1, 47, 43};
    EXPECT_NEAR(rays.first_hit(0, from, {1, 0, 0})->distance, 1, 1e-9);
    EXPECT_NEAR(rays.first_hit(0, from, {1, 0, 0}, {label, 7})->distance, 21, 1e-9);
    EXPECT_NEAR(rays.first_hit(0, {50, 47, 3}, {1, 0, 0}, {label, 3})->distance, 50, 1e-9);
    EXPECT_FALSE(rays.first_hit(0, from, {1, 0, 0}, {label, 8}).has_value());
}

TEST(PreciseRays, AreTheSameOnEitherInstructionSet) {
    const TriangleMesh mesh = shapes::linked_tori();
    const PreciseRays widest(std::array{&mesh});
    const PreciseRays sse(std::array{&mesh}, PreciseRays::Instructions::sse);
    std::size_t hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 from{60 * std::sin(0.37 * i), 60 * std::cos(0.73 * i), 10 * std::sin(1.1 * i)};
        const Vec3 direction = normalized({std::cos(0.8 * i), std::sin(0.31 * i), std::sin(0.17 * i)});
        const auto a = widest.first_hit(0, from, direction);
        const auto b = sse.first_hit(0, from, direction);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        ++hits;
        EXPECT_EQ(a->distance, b->distance);
        EXPECT_EQ(a->triangle, b->triangle);
    }
    EXPECT_GT(hits, 5'000U);
}

}  // namespace
}  // namespace qchopper
