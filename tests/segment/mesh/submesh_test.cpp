#include "segment/mesh/submesh.h"

#include <gtest/gtest.h>

#include <numeric>

#include "segment/mesh/connectivity/shells.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Submesh, KeepsTrianglesPointsAndCaps) {
    TriangleMesh mesh = shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({2, 0, 0}, {3, 1, 1})});
    mesh.cap_of.resize(mesh.triangles.size());
    std::iota(mesh.cap_of.begin(), mesh.cap_of.end(), 0);
    mesh.ignored.assign(mesh.triangles.size(), 0);
    mesh.ignored[13] = 1;
    const TriangleMesh second = submeshes(mesh, shells(mesh).shell_of, 2)[1];
    EXPECT_EQ(second.points.size(), 8U);
    EXPECT_EQ(second.triangles.size(), 12U);
    EXPECT_EQ(second.cap_of.front(), 12);
    EXPECT_EQ(second.ignored[0], 0);
    EXPECT_EQ(second.ignored[1], 1);
    EXPECT_NEAR(volume_mm3(second), 1, 1e-12);
}

}  // namespace
}  // namespace qchopper
