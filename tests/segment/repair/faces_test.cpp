#include "segment/repair/faces.h"

#include <gtest/gtest.h>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

void expect_twice_is_once(const TriangleMesh& mesh) {
    TriangleMesh again = mesh;
    EXPECT_EQ(drop_repeated_faces(again, edges(again)), RepeatedFaces{});
    EXPECT_EQ(again, mesh);
}

// The lowest side of a box.
TriangleMesh flat_square(Vec3 corner, double side, int n) {
    TriangleMesh mesh = shapes::box(corner, corner + Vec3{side, side, side}, n);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.points[t[0]].z > corner.z || mesh.points[t[1]].z > corner.z || mesh.points[t[2]].z > corner.z;
    });
    weld(mesh);
    return mesh;
}

TEST(Faces, ClosedShapesHaveNone) {
    for (const shapes::Named& shape : shapes::all_closed()) expect_twice_is_once(shape.mesh);
}

TEST(Faces, RepeatedOnesGoAndTheFirstStays) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const std::size_t faces = mesh.triangles.size();
        for (std::size_t t = 0; t < faces; t += 3) {
            const Triangle& face = mesh.triangles[t];
            mesh.triangles.push_back({face[1], face[2], face[0]});
        }
        EXPECT_EQ(drop_repeated_faces(mesh, edges(mesh)).repeated, (faces + 2) / 3) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Faces, AFlapOnASurfaceGoesAndTheSurfaceStaysClosed) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const Triangle face = mesh.triangles[mesh.triangles.size() / 2];
        mesh.triangles.push_back({face[0], face[2], face[1]});
        EXPECT_EQ(drop_repeated_faces(mesh, edges(mesh)).repeated, 1U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Faces, AWallBetweenTwoSolidsGoesWithBothSides) {
    TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}, 3), shapes::box({10, 0, 0}, {20, 10, 10}, 3)});
    weld(mesh);
    const RepeatedFaces counts = drop_repeated_faces(mesh, edges(mesh));
    EXPECT_EQ(counts.of_doubled_components, 36U);
    EXPECT_EQ(counts.repeated, 0U);
    EXPECT_TRUE(edges(mesh).faults.is_closed());
    EXPECT_NEAR(volume_mm3(mesh), 2000, 1e-9);
    expect_twice_is_once(mesh);
}

TEST(Faces, AFlatDoubledComponentApartFromTheSolidIsDropped) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 2);
    const TriangleMesh fin = flat_square({20, 20, 20}, 5, 4);
    TriangleMesh mesh = shapes::joined({box, fin, shapes::turned_inside_out(fin)});
    weld(mesh);
    EXPECT_EQ(drop_repeated_faces(mesh, edges(mesh)).of_doubled_components, 2 * fin.triangles.size());
    EXPECT_EQ(mesh.triangles, box.triangles);
    expect_twice_is_once(mesh);
}

TEST(Faces, ASolidWithBothSidesOfItsSurfaceKeepsOne) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shapes::joined({shape.mesh, shapes::turned_inside_out(shape.mesh)});
        weld(mesh);
        EXPECT_EQ(drop_repeated_faces(mesh, edges(mesh)).repeated, shape.mesh.triangles.size()) << shape.name;
        EXPECT_EQ(mesh.triangles, shape.mesh.triangles) << shape.name;
    }
}

TEST(Faces, KeepTheirCapsAndSources) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
    mesh.triangles.insert(mesh.triangles.begin() + 3, mesh.triangles[0]);
    for (std::int32_t i = 0; i < 13; ++i) mesh.cap_of.push_back(i);
    SourceFaces sources{{mesh.cap_of.begin(), mesh.cap_of.end()}};
    drop_repeated_faces(mesh, edges(mesh), &sources);
    EXPECT_EQ(mesh.cap_of, (std::vector<std::int32_t>{0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
    EXPECT_TRUE(std::equal(sources.of.begin(), sources.of.end(), mesh.cap_of.begin(), mesh.cap_of.end()));
}

}  // namespace
}  // namespace qchopper
