#include "segment/mesh/connectivity/edges.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Edges, EveryNamedShapeIsClosedAndTwinsAreMutual) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Edges e = edges(mesh);
        EXPECT_TRUE(e.faults.is_closed()) << name;
        for (std::uint32_t h = 0; h < e.twin.size(); ++h) {
            ASSERT_EQ(e.twin[e.twin[h]], h) << name;
            const Triangle& a = mesh.triangles[h / 3];
            const Triangle& b = mesh.triangles[e.twin[h] / 3];
            ASSERT_EQ(a[h % 3], b[(e.twin[h] + 1) % 3]) << name;
        }
    }
}

TEST(Edges, AMissingTriangleLeavesThreeOpenEdges) {
    TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    EXPECT_EQ(edges(mesh).faults.open, 3U);
}

TEST(Edges, ATurnedTriangleIsInconsistentAtThreeEdges) {
    TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    std::swap(mesh.triangles[100][0], mesh.triangles[100][1]);
    const EdgeFaults faults = edges(mesh).faults;
    EXPECT_EQ(faults.inconsistent, 3U);
    EXPECT_EQ(faults.open, 0U);
    EXPECT_FALSE(faults.is_closed());
}

TEST(Edges, ARepeatedTriangleIsNonManifold) {
    TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    mesh.triangles.push_back(mesh.triangles[100]);
    EXPECT_EQ(edges(mesh).faults.non_manifold, 3U);
}

TEST(Edges, NoTrianglesAreNoFault) {
    EXPECT_TRUE(edges({}).faults.is_closed());
}

}  // namespace
}  // namespace qchopper
