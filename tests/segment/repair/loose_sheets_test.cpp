#include "segment/repair/loose_sheets.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// A triangle at `corner`, closed by its own back, which is new.
TriangleMesh with_closed_sheet(const TriangleMesh& solid, Vec3 corner, double side) {
    TriangleMesh mesh = solid;
    mesh.cap_of.assign(mesh.triangles.size(), 0);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {corner, corner + Vec3{side, 0, 0}, corner + Vec3{0, side, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.cap_of.insert(mesh.cap_of.end(), {0, no_cap});
    return mesh;
}

TEST(LooseSheets, SolidsAreNone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        mesh.cap_of.assign(mesh.triangles.size(), 0);
        const TriangleMesh before = mesh;
        const Sheets counts = judge_sheets(mesh, 0.01);
        EXPECT_EQ(counts.dropped + counts.left, 0U) << shape.name;
        EXPECT_EQ(counts.added_area_share, 0) << shape.name;
        EXPECT_EQ(mesh, before) << shape.name;
    }
}

TEST(LooseSheets, SmallOnesGoAndLargeOnesAreTold) {
    const TriangleMesh solid = shapes::box({0, 0, 0}, {10, 10, 10});
    TriangleMesh small = with_closed_sheet(solid, {20, 20, 20}, 1);
    const Sheets gone = judge_sheets(small, 0.01);
    EXPECT_EQ(gone.dropped, 1U);
    EXPECT_EQ(gone.dropped_faces, 1U);
    EXPECT_EQ(gone.left, 0U);
    EXPECT_EQ(small.triangles, solid.triangles);

    TriangleMesh large = with_closed_sheet(solid, {20, 20, 20}, 12);
    const TriangleMesh before = large;
    const Sheets left = judge_sheets(large, 0.01);
    EXPECT_EQ(left.dropped, 0U);
    EXPECT_EQ(left.left, 1U);
    EXPECT_EQ(left.first, (Vec3{26, 26, 20}));
    EXPECT_EQ(large, before);
}

TEST(LooseSheets, TheLastThingStays) {
    TriangleMesh mesh = with_closed_sheet({}, {0, 0, 0}, 1);
    EXPECT_EQ(judge_sheets(mesh, 1).left, 1U);
    EXPECT_EQ(mesh.triangles.size(), 2U);
}

}  // namespace
}  // namespace qchopper
