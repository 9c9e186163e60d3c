#include "segment/repair/open_components.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// A triangle at `corner`, closed by its own back, which is new.
TriangleMesh with_closed_sheet(const TriangleMesh& solid, Vec3 corner, double side) {
    TriangleMesh mesh = solid;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {corner, corner + Vec3{side, 0, 0}, corner + Vec3{0, side, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 1});
    return mesh;
}

// All of the scan but, with a sheet, the last triangle.
SourceFaces sources_of(const TriangleMesh& mesh, bool has_sheet) {
    SourceFaces sources{std::vector<std::uint32_t>(mesh.triangles.size(), 0)};
    if (has_sheet) sources.of.back() = new_face;
    return sources;
}

TEST(OpenComponents, SolidsAreNone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        SourceFaces sources = sources_of(mesh, false);
        const Sheets counts = judge_sheets(mesh, sources, 0.01);
        EXPECT_EQ(counts.dropped + counts.left, 0U) << shape.name;
        EXPECT_EQ(counts.added_area_share, 0) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(OpenComponents, SmallOnesGoAndLargeOnesAreTold) {
    const TriangleMesh solid = shapes::box({0, 0, 0}, {10, 10, 10});
    TriangleMesh small = with_closed_sheet(solid, {20, 20, 20}, 1);
    SourceFaces sources = sources_of(small, true);
    const Sheets gone = judge_sheets(small, sources, 0.01);
    EXPECT_EQ(gone.dropped, 1U);
    EXPECT_EQ(gone.dropped_faces, 1U);
    EXPECT_EQ(gone.left, 0U);
    EXPECT_EQ(small.triangles, solid.triangles);
    EXPECT_EQ(sources.of, sources_of(solid, false).of);

    TriangleMesh large = with_closed_sheet(solid, {20, 20, 20}, 12);
    const TriangleMesh before = large;
    sources = sources_of(large, true);
    const Sheets left = judge_sheets(large, sources, 0.01);
    EXPECT_EQ(left.dropped, 0U);
    EXPECT_EQ(left.left, 1U);
    EXPECT_EQ(left.first, (Vec3{26, 26, 20}));
    EXPECT_EQ(large, before);
}

TEST(OpenComponents, TheLastThingStays) {
    TriangleMesh mesh = with_closed_sheet({}, {0, 0, 0}, 1);
    SourceFaces sources = sources_of(mesh, true);
    EXPECT_EQ(judge_sheets(mesh, sources, 1).left, 1U);
    EXPECT_EQ(mesh.triangles.size(), 2U);
}

}  // namespace
}  // namespace qchopper
