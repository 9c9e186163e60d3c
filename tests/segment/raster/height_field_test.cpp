#include "segment/raster/height_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/rays.h"
#include "segment/sample/sample.h"
#include "tests/reference/cam/setup/remaining_volume.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const TriangleMesh& bone() {
    static const TriangleMesh mesh = sample(Specimen::vertebra, {.faces = 40'000});
    return mesh;
}

double area(const TriangleMesh& mesh, std::size_t t) {
    return norm(area_vector(mesh, t));
}

// Area of the triangles that are more than `sine` turned towards the direction, reached by rays from their middles, and
// by the map.
struct ReachedAreas {
    double by_rays = 0;
    double by_map = 0;
    double all = 0;
};

ReachedAreas reached_areas(const TriangleMesh& mesh, Vec3 direction, double cell) {
    const HeightField map = height_field(mesh, direction, cell);
    const std::vector<float> share = reached_share(mesh, map);
    const RayTree rays(mesh);
    const double sine = std::sin(5 * M_PI / 180);  // nearer to the direction the two may differ
    const double off = 1e-6 * norm(bounds(mesh).size());
    ReachedAreas areas;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        areas.all += area(mesh, t);
        const Vec3 n = normalized(area_vector(mesh, t));
        if (dot(n, direction) < sine) continue;
        const Triangle& v = mesh.triangles[t];
        const Vec3 middle = (1.0 / 3) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
        if (!rays.meets(middle + 10 * off * n, direction)) areas.by_rays += area(mesh, t);
        areas.by_map += static_cast<double>(share[t]) * area(mesh, t);
    }
    return areas;
}

TEST(HeightField, ReachesTheAreaThatRaysReach) {
    const TriangleMesh& mesh = bone();
    const double cell = norm(bounds(mesh).size()) / 1500;
    for (const Vec3 d :
         {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, normalized({0.3, -0.5, 0.8}), normalized({-0.9, 0.2, -0.1})}) {
        const ReachedAreas areas = reached_areas(mesh, d, cell);
        EXPECT_GT(areas.by_rays, 0.1 * areas.all);
        EXPECT_NEAR(areas.by_map / areas.all, areas.by_rays / areas.all, 0.005) << d.x << " " << d.y << " " << d.z;
    }
}

TEST(HeightField, LargeTrianglesAreReachedInPart) {
    // A roof over half of a plate: half of the plate's upper side lies under it.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {100, 40, 5}), shapes::box({0, 0, 20}, {50, 40, 25})});
    const HeightField map = height_field(mesh, {0, 0, 1}, 0.5);
    const std::vector<float> share = reached_share(mesh, map);
    double reached = 0;
    for (std::size_t t = 0; t < share.size(); ++t) reached += static_cast<double>(share[t]) * area(mesh, t);
    EXPECT_NEAR(reached, 100 * 40, 100 * 40 * 0.01) << "seen from above, every line is met once";
}

TEST(HeightField, HeightsAreThoseOfTheSurface) {
    const TriangleMesh ball = shapes::ball({500, -300, 900}, 50, 60);
    const HeightField map = height_field(ball, {0, 0, 1}, 1);
    std::size_t compared = 0;
    for (std::size_t row = 0; row < map.rows; ++row) {
        for (std::size_t column = 0; column < map.columns; ++column) {
            const Vec3 middle{(static_cast<double>(column) + 0.5) * map.cell,
                              (static_cast<double>(row) + 0.5) * map.cell, 0};
            const Vec3 p = apply_inverse(map.piece_in_field, middle) - Vec3{500, -300, 900};
            const double square = 50 * 50 - p.x * p.x - p.y * p.y;
            if (square < 100) continue;
            EXPECT_NEAR(map.at(column, row), std::sqrt(square), 0.6);
            ++compared;
        }
    }
    EXPECT_GT(compared, 5000U);
}

TEST(HeightField, IsTheSameOnAnyNumberOfThreads) {
    const TriangleMesh& mesh = bone();
    const HeightField all = height_field(mesh, normalized({0.1, 0.2, 0.9}), 0.5);
    const ThreadLimit one(1);
    const HeightField same = height_field(mesh, normalized({0.1, 0.2, 0.9}), 0.5);
    EXPECT_EQ(all.height, same.height);
    EXPECT_EQ(reached_share(mesh, all), reached_share(mesh, same));
}

TEST(HeightField, RefusesMoreCellsThanThereMayBe) {
    EXPECT_THROW(height_field(shapes::box({0, 0, 0}, {1000, 1000, 1}), {0, 0, 1}, 0.01), InputError);
}

// A slot of 12 mm between two walls: a ball of radius 10 touches both walls' edges, one of radius 4 its floor.
TEST(ClosedByBall, FillsWhatTheToolCannotEnter) {
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {40, 60, 30}), shapes::box({52, 0, 0}, {92, 60, 30}),
                        shapes::box({40, 0, 0}, {52, 60, 5})});
    const HeightField map = height_field(mesh, {0, 0, 1}, 0.5);
    const auto middle = [&](const HeightField& m) { return m.at(m.columns / 2, m.rows / 2); };
    // The map may be turned: the middle of the slot is the middle of the map in any case.
    EXPECT_NEAR(middle(map), 5 - 15, 1e-3);
    EXPECT_NEAR(middle(closed_by_ball(map, 4)), 5 - 15, 1e-3);
    const double sunk = 10 - std::sqrt(10 * 10 - 6 * 6);
    EXPECT_NEAR(middle(closed_by_ball(map, 10)), 30 - 15 - sunk, 0.5);
}

// On the whole: a ball of whole cells is no part of a larger one at every cell.
TEST(ClosedByBall, IsNeverLowerAndGrowsWithTheTool) {
    const TriangleMesh& mesh = bone();
    const HeightField map = coarser(height_field(mesh, {0, 0, 1}, 0.5), 4);
    const HeightField small = closed_by_ball(map, 6);
    const HeightField large = closed_by_ball(map, 12);
    double grown = 0;
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        ASSERT_LE(map.height[i], small.height[i]);
        ASSERT_LE(map.height[i], large.height[i]);
        if (std::isfinite(map.height[i])) grown += static_cast<double>(large.height[i] - small.height[i]);
    }
    EXPECT_GT(grown, 0);
}

TEST(RemainingVolume, OfOneDirectionIsWhatLiesUnderTheSurface) {
    // The plate and its roof: foam between them stays.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {100, 40, 5}), shapes::box({0, 0, 20}, {50, 40, 25})});
    const std::vector<HeightField> up{height_field(mesh, {0, 0, 1}, 0.5)};
    const Pose box_in_piece{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {-5, -5, 0}};
    const Vec3 box{110, 50, 30};
    EXPECT_NEAR(remaining_volume(up, box, box_in_piece, 0.5), 100 * 40 * 5 + 50 * 40 * 20, 1000);
    // From the side as well, the space below the roof is reached from its open end.
    const std::vector<HeightField> both{up.front(), height_field(mesh, {1, 0, 0}, 0.5)};
    EXPECT_NEAR(remaining_volume(both, box, box_in_piece, 0.5), volume_mm3(mesh), 1000);
}

}  // namespace
}  // namespace qchopper
