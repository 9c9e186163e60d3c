#include "segment/sample/refine.h"

#include <gtest/gtest.h>

#include "tests/segment/sample/invariants.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Refine, AddsTwoTrianglesPerSplitAndKeepsTheShape) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const std::size_t before = mesh.triangles.size();
        const std::size_t split = split_longest_edges(mesh, before / 6);
        EXPECT_EQ(split, before / 6) << shape.name;
        EXPECT_EQ(mesh.triangles.size(), before + 2 * split) << shape.name;
        EXPECT_TRUE(edges(mesh).faults.is_closed()) << shape.name;
        EXPECT_NEAR(volume_mm3(mesh), volume_mm3(shape.mesh), 1e-9 * std::abs(volume_mm3(shape.mesh))) << shape.name;
        EXPECT_NEAR(area_mm2(mesh), area_mm2(shape.mesh), 1e-9 * area_mm2(shape.mesh)) << shape.name;
    }
}

TEST(Refine, SplitsTheLongestEdge) {
    TriangleMesh box = shapes::box({0, 0, 0}, {30, 1, 1});
    EXPECT_EQ(split_longest_edges(box, 1), 1U);
    EXPECT_NEAR(box.points.back().x, 15, 1e-12);
}

TEST(Refine, ReturnsTheNumberOfEdgesSplit) {
    TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    const std::size_t split = split_longest_edges(box, 1000);
    EXPECT_LE(split, 6U);
    EXPECT_GE(split, 4U);
    EXPECT_EQ(box.triangles.size(), 12 + 2 * split);
}

}  // namespace
}  // namespace qchopper
