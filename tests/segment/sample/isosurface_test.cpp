#include "segment/sample/isosurface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "segment/sample/bones.h"
#include "tests/segment/sample/invariants.h"
#include "tests/segment/sample/self_intersections.h"

namespace qchopper {
namespace {

Bone ball_of(double radius) {
    Bone bone;
    bone.field.parts = {added(0, {ball({1, 2, 3}, radius)})};
    bone.box = {{-radius - 5, -radius - 5, -radius - 5}, {radius + 6, radius + 7, radius + 8}};
    return bone;
}

TEST(Isosurface, OfABallIsABall) {
    const Bone bone = ball_of(20);
    const TriangleMesh mesh = isosurface(bone.field, bone.box, 1.3, {});
    expect_valid_solid(mesh);
    EXPECT_EQ(genus(mesh), 0);
    EXPECT_NEAR(volume_mm3(mesh), 4.0 / 3 * std::numbers::pi * 8000, 150);
    for (const Vec3& p : mesh.points) EXPECT_NEAR(norm(p - Vec3{1, 2, 3}), 20, 0.11);  // 8 % of an edge at most
}

TEST(Isosurface, HasAsManyTrianglesAsCounted) {
    for (const Bone& bone : {vertebra(), femur(), skull(), ball_of(10)}) {
        const double spacing = bone.base_spacing > 0 ? 2 * bone.base_spacing : 1;
        EXPECT_EQ(isosurface(bone.field, bone.box, spacing, {}).triangles.size(),
                  count_triangles(bone.field, bone.box, spacing, {}));
    }
}

// Whatever the lattice, also one much too coarse for the shape.
TEST(Isosurface, IsValidOnEveryLattice) {
    for (const Bone& bone : {vertebra(), femur(), skull()}) {
        for (const double factor : {1.3, 3.1, 8.0}) {
            const TriangleMesh mesh = isosurface(bone.field, bone.box, factor * bone.base_spacing, {});
            const Edges found = edges(mesh);
            EXPECT_TRUE(found.faults.is_closed());
            EXPECT_EQ(non_manifold_vertices(mesh, found), 0U);
            EXPECT_EQ(count_self_intersections(mesh), 0U);
            EXPECT_GT(volume_mm3(mesh), 0);
        }
    }
}

TEST(Isosurface, NeighboursInTheListLieCloseTogether) {
    const Bone bone = femur();
    const TriangleMesh mesh = isosurface(bone.field, bone.box, bone.base_spacing, {});
    double sum = 0;
    for (std::size_t t = 1; t < mesh.triangles.size(); ++t) {
        sum += norm(mesh.points[mesh.triangles[t][0]] - mesh.points[mesh.triangles[t - 1][0]]);
    }
    EXPECT_LT(sum / static_cast<double>(mesh.triangles.size()), 3 * bone.base_spacing);
}

}  // namespace
}  // namespace qchopper
