#include "segment/repair/weld.h"

#include <gtest/gtest.h>

#include <cmath>

#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Weld, ClosesWhatAnStlFileTearsApart) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh torn = parse_mesh(to_stl(shape.mesh), shape.name).mesh;
        EXPECT_FALSE(edges(torn).faults.is_closed()) << shape.name;
        const WeldCounts counts = weld(torn);
        EXPECT_TRUE(edges(torn).faults.is_closed()) << shape.name;
        EXPECT_EQ(counts.welded, 3 * torn.triangles.size() - torn.points.size()) << shape.name;
    }
}

TEST(Weld, OnceIsAsGoodAsTwice) {
    TriangleMesh mesh = parse_mesh(to_stl(shapes::nested()), "test").mesh;
    weld(mesh);
    const TriangleMesh once = mesh;
    EXPECT_EQ(weld(mesh), WeldCounts{});
    EXPECT_EQ(mesh, once);
}

TEST(Weld, KeepsTheOrderOfFirstAppearance) {
    TriangleMesh mesh;
    mesh.points = {{9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    mesh.triangles = {{3, 5, 4}};
    const WeldCounts counts = weld(mesh);
    EXPECT_EQ(counts, (WeldCounts{2, 0, 1}));
    EXPECT_EQ(mesh.points, (std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Weld, DropsCollapsedTrianglesAndKeepsCapsAndSourcesInStep) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    mesh.triangles = {{0, 1, 3}, {0, 1, 2}, {2, 2, 1}};
    mesh.cap_of = {5, 6, 7};
    SourceFaces sources{{8, 9, new_face}};
    EXPECT_EQ(weld(mesh, &sources), (WeldCounts{1, 2, 0}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_EQ(mesh.cap_of, (std::vector<std::int32_t>{6}));
    EXPECT_EQ(sources.of, (std::vector<std::uint32_t>{9}));
}

TEST(Weld, BothZerosAreOne) {
    TriangleMesh mesh;
    mesh.points = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 1, 4}};
    EXPECT_EQ(weld(mesh).welded, 1U);
    for (const Vec3& p : mesh.points) EXPECT_FALSE(std::signbit(p.x) || std::signbit(p.y));
}

}  // namespace
}  // namespace qchopper
