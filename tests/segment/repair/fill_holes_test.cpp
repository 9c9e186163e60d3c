#include "segment/repair/fill_holes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

void expect_starts_with(const TriangleMesh& filled, const TriangleMesh& open) {
    EXPECT_EQ(filled.points, open.points);
    ASSERT_GE(filled.triangles.size(), open.triangles.size());
    EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), filled.triangles.begin()));
}

TEST(FillHoles, ClosesEveryShapeFromWhichATriangleIsMissing) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2));
        const TriangleMesh open = mesh;
        const FilledHoles holes = fill_holes(mesh);
        EXPECT_EQ(holes.filled, 1U) << shape.name;
        EXPECT_EQ(holes.triangles, 1U) << shape.name;
        EXPECT_TRUE(edges(mesh).faults.is_closed()) << shape.name;
        expect_starts_with(mesh, open);
        EXPECT_DOUBLE_EQ(volume_mm3(mesh), volume_mm3(shape.mesh)) << shape.name;
    }
}

TEST(FillHoles, FillsEdgesMinusTwoTrianglesPerHoleAndNoPoint) {
    TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 8);
    std::erase_if(box.triangles, [&](const Triangle& t) {  // a side of the box, with its rim
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return box.points[v].z == 10; });
    });
    weld(box);
    const std::size_t border = edges(box).faults.open;
    ASSERT_EQ(border, 32U);
    const TriangleMesh open = box;
    FillOptions flat;
    flat.fill = Fill::flat;
    const FilledHoles holes = fill_holes(box, flat);
    EXPECT_EQ(holes.filled, 1U);
    EXPECT_EQ(holes.triangles, border - 2);
    expect_starts_with(box, open);
    EXPECT_NEAR(volume_mm3(box), 1000, 1e-9);
}

TEST(FillHoles, LeavesAClosedMeshAlone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(fill_holes(mesh).filled, 0U);
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(FillHoles, CapsStayInStep) {
    TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    mesh.triangles.pop_back();
    mesh.cap_of.assign(mesh.triangles.size(), 4);
    fill_holes(mesh);
    ASSERT_EQ(mesh.cap_of.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.cap_of.front(), 4);
    EXPECT_EQ(mesh.cap_of.back(), no_cap);
}

TEST(FillHoles, TheBunnyGets69664Faces) {
    NEEDS_MESH("bunny_bun_zipper.ply");
    TriangleMesh bunny = read_mesh(real_mesh("bunny_bun_zipper.ply")).mesh;
    EXPECT_EQ(weld(bunny), (WeldCounts{0, 0, 1113}));
    const TriangleMesh open = bunny;
    ASSERT_EQ(open.triangles.size(), 69451U);
    const FilledHoles holes = fill_holes(bunny);
    EXPECT_EQ(holes.filled, 5U);
    EXPECT_EQ(holes.triangles, 213U);
    EXPECT_EQ(bunny.triangles.size(), 69664U);
    EXPECT_TRUE(holes.left.empty());
    expect_starts_with(bunny, open);
    EXPECT_TRUE(edges(bunny).faults.is_closed());
    EXPECT_EQ(shells(bunny).count(), 1U);
    TriangleMesh again = open;
    fill_holes(again);
    EXPECT_EQ(again, bunny);
}

}  // namespace
}  // namespace qchopper
