#include "segment/mesh/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<std::uint32_t> all_of(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> triangles(mesh.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    return triangles;
}

TEST(Distance, IsZeroWhenNothingChanged) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh turned = shapes::turned_inside_out(shape.mesh);
        std::reverse(turned.triangles.begin(), turned.triangles.end());
        const Deviation same = deviation(shape.mesh, turned);
        EXPECT_EQ(same.from_scan.triangles + same.from_result.triangles, 0U) << shape.name;
        EXPECT_EQ(same.largest().mm, 0) << shape.name;
    }
}

TEST(Distance, OfShapesThatWereMovedIsBounded) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Deviation moved = deviation(shape.mesh, shapes::moved(shape.mesh, {0, 0, 0.125}));
        for (const OneSidedDistance& one_way : {moved.from_scan, moved.from_result}) {
            EXPECT_LE(one_way.mm, 0.125 + 1e-9) << shape.name;
            EXPECT_GE(one_way.at_most, one_way.mm) << shape.name;
            EXPECT_LE(one_way.at_most, 1.01 * one_way.mm + 1e-4 + 1e-12) << shape.name;
        }
    }
}

TEST(Distance, OfABoxThatGrewIsThatOfItsCorner) {
    const Deviation grown = deviation(shapes::box({0, 0, 0}, {4, 4, 4}, 2), shapes::box({0, 0, 0}, {7, 8, 4}, 2));
    EXPECT_NEAR(grown.from_result.mm, 5, 0.05);  // corner (7, 8) from (4, 4)
    EXPECT_GE(grown.from_result.at_most, 5);
    // The old corner (4, 4, 2) lies deep inside: 2 from top and bottom. Points farther inside are covered as well.
    EXPECT_NEAR(grown.from_scan.mm, 2, 0.03);
}

// All corners of the lid lie on the ball, its middle does not: the interior of triangles counts.
TEST(Distance, CoversTheInteriorOfLargeFaces) {
    const double radius = 10;
    const TriangleMesh ball = shapes::ball({0, 0, 0}, radius, 64);
    TriangleMesh lid;
    const double r = radius * std::sin(1.0);
    const double h = radius * std::cos(1.0);
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * 3.14159265358979 * k / 3;
        lid.points.push_back({r * std::cos(angle), r * std::sin(angle), h});
    }
    lid.triangles = {{0, 1, 2}};
    const OneSidedDistance found = one_sided_distance(lid, all_of(lid), ball);
    EXPECT_NEAR(found.mm, radius - h, 0.1);
    EXPECT_NEAR(norm(found.at - Vec3{0, 0, h}), 0, 1.5);
    EXPECT_GE(found.at_most, found.mm);
}

TEST(Distance, LeavesOutWhatHasNotChanged) {
    TriangleMesh scan = shapes::box({0, 0, 0}, {4, 4, 4}, 4);
    TriangleMesh result = scan;
    result.points.push_back(result.points[result.triangles[5][0]] + Vec3{0, 0, 1});
    result.triangles[5][0] = static_cast<std::uint32_t>(result.points.size() - 1);
    const Deviation found = deviation(scan, result);
    EXPECT_EQ(found.from_scan.triangles, 1U);
    EXPECT_EQ(found.from_result.triangles, 1U);
    EXPECT_GT(found.largest().mm, 0.2);
    EXPECT_LE(found.largest().mm, 1 + 1e-12);
}

// The same surface in other triangles, as where a face was split or one of two that coincide was dropped: parts lie
// across sides of the others everywhere, and there is no distance to find.
TEST(Distance, BetweenTheSameSurfaceInOtherTrianglesIsFoundWithFewPoints) {
    const TriangleMesh coarse = shapes::rotated(shapes::box({0, 0, 0}, {60, 50, 40}, 3), {1, 2, 3}, 0.7);
    const TriangleMesh fine = shapes::rotated(shapes::box({0, 0, 0}, {60, 50, 40}, 5), {1, 2, 3}, 0.7);
    DistanceOptions options;
    options.tolerance_mm = 1e-5;
    options.max_points = 200'000;
    for (const auto& [from, to] : {std::pair(&coarse, &fine), std::pair(&fine, &coarse)}) {
        const OneSidedDistance found = one_sided_distance(*from, all_of(*from), *to, options);
        EXPECT_LE(found.mm, 1e-12);
        EXPECT_LE(found.at_most, 1e-5 + 1e-12) << "all parts are settled before the points run out";
    }
}

// Bounds are those of many points of the triangles.
TEST(Distance, NoPointIsFartherThanTheBound) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    for (const shapes::Named& shape : shapes::all_closed()) {
        const TriangleMesh other = shapes::moved(shapes::rotated(shape.mesh, {1, 1, 2}, 0.1), {0.3, -0.2, 0.1});
        DistanceOptions options;
        options.tolerance = 0.02;
        const OneSidedDistance found = one_sided_distance(shape.mesh, all_of(shape.mesh), other, options);
        const TriangleTree tree(other);
        for (int i = 0; i < 3'000; ++i) {
            const auto [a, b, c] = corners_of(shape.mesh, random() % shape.mesh.triangles.size());
            const double u = share(random);
            const double v = share(random) * (1 - u);
            const Vec3 p = a + u * (b - a) + v * (c - a);
            EXPECT_LE(tree.nearest(other, p).distance, found.at_most + 1e-12) << shape.name;
        }
        EXPECT_LE(found.at_most, 1.02 * found.mm + options.tolerance_mm + 1e-12) << shape.name;
    }
}

TEST(Distance, ToNothingIsInfinite) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(std::isinf(deviation(box, {}).from_scan.mm));
    EXPECT_EQ(deviation({}, {}).largest().mm, 0);
}

TEST(Distance, StaysABoundWhenFewPointsAreAllowed) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 32);
    const TriangleMesh box = shapes::box({-8, -8, -8}, {8, 8, 8});
    DistanceOptions hasty;
    hasty.max_points = 1;
    const OneSidedDistance rough = one_sided_distance(box, all_of(box), ball, hasty);
    const OneSidedDistance fine = one_sided_distance(box, all_of(box), ball);
    EXPECT_LE(rough.mm, fine.at_most);
    EXPECT_GE(rough.at_most, fine.mm);
}

TEST(Distance, IsTheSameOnAnyNumberOfThreads) {
    const TriangleMesh a = shapes::ball({0, 0, 0}, 10, 24);
    const TriangleMesh b = shapes::torus({1, 0, 0}, 6, 3);
    Deviation found[2];
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        found[threads - 1] = deviation(a, b);
    }
    EXPECT_EQ(found[0].from_scan.mm, found[1].from_scan.mm);
    EXPECT_EQ(found[0].from_scan.at_most, found[1].from_scan.at_most);
    EXPECT_EQ(found[0].from_result.at, found[1].from_result.at);
}

}  // namespace
}  // namespace qchopper
