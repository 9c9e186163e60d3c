#include "segment/mesh/connectivity/solids.h"

#include <gtest/gtest.h>

#include "segment/mesh/connectivity/edges.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const Vec3 axes[] = {{0, 0, 1}, {1, 0, 0}, {0.3, -0.5, 0.81}, {-0.7, 0.1, 0.2}};

TEST(Shells, SolidsOfTheNamedShapesAreCountedAlongEveryAxis) {
    for (const auto& [name, mesh, expected] : shapes::all_closed()) {
        for (const Vec3& axis : axes) {
            EXPECT_EQ(solids(mesh, shells(mesh), axis).count, expected) << name;
        }
    }
}

TEST(Shells, SolidsAreClosedAndTheirVolumesAddUp) {
    for (const auto& [name, mesh, expected] : shapes::all_closed()) {
        double sum = 0;
        std::size_t triangles = 0;
        for (const TriangleMesh& solid : split_solids(mesh, {0, 0, 1})) {
            EXPECT_TRUE(edges(solid).faults.is_closed()) << name;
            EXPECT_GT(volume_mm3(solid), 0) << name;
            sum += volume_mm3(solid);
            triangles += solid.triangles.size();
        }
        EXPECT_NEAR(sum / volume_mm3(mesh), 1, 1e-9) << name;
        EXPECT_EQ(triangles, mesh.triangles.size()) << name;
    }
}

TEST(Shells, ManyCavitiesInARowAllJoinTheirSolid) {
    std::vector<TriangleMesh> parts{shapes::box({0, 0, 0}, {100, 20, 20})};
    for (int i = 0; i < 9; ++i) {
        parts.push_back(shapes::turned_inside_out(shapes::ball({10.0 + 10 * i, 10, 10}, 4, 6)));
    }
    const TriangleMesh mesh = shapes::joined(parts);
    for (const Vec3& axis : axes) EXPECT_EQ(solids(mesh, shells(mesh), axis).count, 1U);
}

TEST(Shells, AShellInsideOutBesideAnotherIsASolidOfItsOwn) {
    const TriangleMesh mesh = shapes::joined(
        {shapes::turned_inside_out(shapes::box({0, 0, 0}, {10, 10, 10})), shapes::box({20, 0, 0}, {30, 10, 10})});
    for (const Vec3& axis : axes) EXPECT_EQ(solids(mesh, shells(mesh), axis).count, 2U);
}

}  // namespace
}  // namespace qchopper
