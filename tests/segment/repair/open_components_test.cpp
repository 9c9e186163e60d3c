#include "segment/repair/open_components.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// The solid and, beside it, an open component: a triangle at `corner`, filled by its own back, which is new.
TriangleMesh with_filled_triangle(const TriangleMesh& solid, Vec3 corner, double side) {
    TriangleMesh mesh = solid;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {corner, corner + Vec3{side, 0, 0}, corner + Vec3{0, side, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 1});
    return mesh;
}

// All triangles are of the scan but, with an open component, the last one.
SourceFaces sources_of(const TriangleMesh& mesh, bool has_open_component) {
    SourceFaces sources{std::vector<std::uint32_t>(mesh.triangles.size(), 0)};
    if (has_open_component) sources.of.back() = new_face;
    return sources;
}

TEST(OpenComponents, SolidsAreNone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        SourceFaces sources = sources_of(mesh, false);
        const OpenComponents counts = drop_open_components(mesh, sources, 0.01);
        EXPECT_EQ(counts.dropped + counts.left, 0U) << shape.name;
        EXPECT_EQ(counts.added_area_share, 0) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(OpenComponents, SmallOnesAreDroppedAndLargeOnesCounted) {
    const TriangleMesh solid = shapes::box({0, 0, 0}, {10, 10, 10});
    TriangleMesh small = with_filled_triangle(solid, {20, 20, 20}, 1);
    SourceFaces sources = sources_of(small, true);
    const OpenComponents gone = drop_open_components(small, sources, 0.01);
    EXPECT_EQ(gone.dropped, 1U);
    EXPECT_EQ(gone.dropped_faces, 1U);
    EXPECT_EQ(gone.left, 0U);
    EXPECT_EQ(small.triangles, solid.triangles);
    EXPECT_EQ(sources.of, sources_of(solid, false).of);

    TriangleMesh large = with_filled_triangle(solid, {20, 20, 20}, 12);
    const TriangleMesh before = large;
    sources = sources_of(large, true);
    const OpenComponents left = drop_open_components(large, sources, 0.01);
    EXPECT_EQ(left.dropped, 0U);
    EXPECT_EQ(left.left, 1U);
    EXPECT_EQ(left.first, (Vec3{26, 26, 20}));
    EXPECT_EQ(large, before);
}

TEST(OpenComponents, TheLastThingStays) {
    TriangleMesh mesh = with_filled_triangle({}, {0, 0, 0}, 1);
    SourceFaces sources = sources_of(mesh, true);
    EXPECT_EQ(drop_open_components(mesh, sources, 1).left, 1U);
    EXPECT_EQ(mesh.triangles.size(), 2U);
}

}  // namespace
}  // namespace qchopper
