#include "segment/intake/inspect.h"

#include <gtest/gtest.h>

#include "segment/intake/write_stl.h"
#include "tests/segment/intake/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

RawMesh raw(const TriangleMesh& mesh) {
    RawMesh scan;
    scan.mesh = mesh;
    scan.faces_in_file = mesh.triangles.size();
    return scan;
}

TEST(Inspect, FindsNothingWrongWithClosedShapes) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (const RawMesh& scan : {raw(shape.mesh), parse_mesh(to_stl(shape.mesh), shape.name)}) {
            const Inspection found = inspect(scan);
            EXPECT_TRUE(found.is_closed()) << shape.name;
            EXPECT_EQ(found.triangles, shape.mesh.triangles.size()) << shape.name;
            EXPECT_EQ(found.vertices, shape.mesh.points.size()) << shape.name;
            EXPECT_EQ(found.inside_out, 0U) << shape.name;
            EXPECT_EQ(found.holes.size(), 0U) << shape.name;
            EXPECT_NEAR(found.volume / volume_mm3(shape.mesh), 1, 1e-3) << shape.name;
            EXPECT_NEAR(found.area / area_mm2(shape.mesh), 1, 1e-3) << shape.name;
        }
    }
}

TEST(Inspect, CountsEveryFault) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    mesh.triangles.pop_back();
    EXPECT_EQ(inspect(raw(mesh)).open_edges, 3U);
    ASSERT_EQ(inspect(raw(mesh)).holes.size(), 1U);
    EXPECT_EQ(inspect(raw(mesh)).holes[0].edges, 3U);

    mesh.points.push_back({50, 50, 50});
    mesh.triangles.push_back({0, 0, 1});
    const Inspection found = inspect(raw(mesh));
    EXPECT_EQ(found.unreferenced, 1U);
    EXPECT_EQ(found.collapsed, 1U);
    EXPECT_EQ(found.box, (Box{{0, 0, 0}, {2, 2, 2}}));
    EXPECT_EQ(found.triangles_in_file, 48U);
    EXPECT_EQ(found.triangles, 47U);

    TriangleMesh turned = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_EQ(inspect(raw(turned)).inconsistent, 3U);
    EXPECT_EQ(inspect(raw(turned)).shells, 1U);

    TriangleMesh twice = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    twice.triangles.push_back(twice.triangles[0]);
    EXPECT_EQ(inspect(raw(twice)).non_manifold, 3U);

    EXPECT_EQ(
        inspect(raw(shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 1}, {2, 2, 2})}))).pinched,
        1U);

    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.triangles = {{0, 1, 2}};
    EXPECT_EQ(inspect(raw(flat)).no_area, 1U);
}

TEST(Inspect, TellsCavitiesFromShellsThatAreInsideOut) {
    const TriangleMesh ball = shapes::turned_inside_out(shapes::ball({5, 5, 5}, 2));
    EXPECT_EQ(inspect(raw(ball)).inside_out, 1U);
    const Inspection hollow = inspect(raw(shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}), ball})));
    EXPECT_EQ(hollow.inside_out, 0U);
    EXPECT_EQ(hollow.cavities, 1U);
    EXPECT_EQ(hollow.shells, 2U);
}

TEST(Inspect, DescribesTheRealScansWithoutAWord) {
    NEEDS_MESH("nasty");
    const Inspection bunny = inspect(read_mesh(real_mesh("bunny_bun_zipper.ply")));
    EXPECT_EQ(bunny.holes.size(), 5U);
    EXPECT_EQ(bunny.open_edges, 223U);
    EXPECT_EQ(bunny.unreferenced, 1113U);
    const Inspection head = inspect(read_mesh(real_mesh("ct_head_371k.ply")));
    EXPECT_EQ(head.shells, 222U);
    EXPECT_EQ(head.cavities, 39U);
    EXPECT_EQ(head.collapsed, 6U);
    const Inspection router = inspect(read_mesh(real_mesh("nasty/ocl_stl_mount_rush.stl")));
    EXPECT_EQ(router.non_manifold, 1645U);
    EXPECT_EQ(router.inconsistent, 686U);
    EXPECT_EQ(router.open_edges, 862U);
    EXPECT_EQ(inspect(read_mesh(real_mesh("nasty/made_inside_out.stl"))).open_edges, 223U);
}

TEST(Inspect, SaysSizesInWords) {
    EXPECT_EQ(size_in_words({1820, 940, 710}), "1.82 m x 0.94 m x 0.71 m");
    EXPECT_EQ(size_in_words({999.4, 15, 345}), "99.9 cm x 1.5 cm x 34.5 cm");
    EXPECT_EQ(size_in_words({12, 3.456, 99.9}), "12.0 mm x 3.5 mm x 99.9 mm");
    EXPECT_EQ(size_in_words({999.6, 1, 1}), "1.00 m x 0.00 m x 0.00 m");
    EXPECT_EQ(size_in_words({25000, 18000, 3000}), "25.0 m x 18.0 m x 3.0 m");
    EXPECT_EQ(size_in_words({0, 0, 0}), "0.00 mm x 0.00 mm x 0.00 mm");
    EXPECT_FALSE(size_in_words({1e308, 1e308, 1e308}).empty());
}

}  // namespace
}  // namespace qchopper
