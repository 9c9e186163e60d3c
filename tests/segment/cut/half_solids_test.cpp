#include "segment/cut/half_solids.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// A pyramid of 100 mm with a cavity from z = 22 to 38: the link of the cavity meets a wall that reaches from the base
// to the tip.
TriangleMesh hollow_pyramid() {
    const TriangleMesh cavity = shapes::turned_inside_out(shapes::ball({50, 50, 30}, 8));
    return shapes::joined({shapes::pyramid({0, 0, 0}, 100, 100), cavity});
}

TEST(HalfSolids, ACavityBesideThePlaneStaysInTheSolidOfItsWall) {
    const TriangleMesh mesh = hollow_pyramid();
    for (const double offset : {10.3, 21.7, 38.4, 70.1}) {
        const Plane plane{{0, 0, 1}, offset};
        const std::optional<CutHalves> halves = cut(mesh, plane, 1);
        ASSERT_TRUE(halves);
        const SolidsOfHalves solids = solids_of_halves(mesh, plane, *halves);
        EXPECT_EQ(solids.above.shells.count() + solids.below.shells.count(), 3U) << offset;
        EXPECT_EQ(solids.above.solids.count, 1U) << offset;
        EXPECT_EQ(solids.below.solids.count, 1U) << offset;
    }
}

TEST(HalfSolids, TheFarCornerIsTheHighestOrTheLowestOne) {
    const TriangleMesh mesh = shapes::pyramid({0, 0, 0}, 100, 100);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.6, 0, -0.8}}) {
            const double highest = height(normal, mesh.points[far_corner(mesh, {0, 0, t}, normal, true)]);
            const double lowest = height(normal, mesh.points[far_corner(mesh, {0, 0, t}, normal, false)]);
            for (const std::uint32_t v : mesh.triangles[t]) {
                EXPECT_LE(height(normal, mesh.points[v]), highest);
                EXPECT_GE(height(normal, mesh.points[v]), lowest);
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
