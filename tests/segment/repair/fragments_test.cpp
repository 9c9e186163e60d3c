#include "segment/repair/fragments.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Fragments, ShapesHaveNone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(drop_fragments(mesh, 1e-5).fragments, 0U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Fragments, GoWholeWithTheirCavities) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Vec3 beside = bounds(shape.mesh).max + Vec3{5, 5, 5};
        const TriangleMesh fragment =
            shapes::joined({shapes::ball(beside, 0.02, 6), shapes::turned_inside_out(shapes::ball(beside, 0.01, 6))});
        TriangleMesh mesh = shapes::joined({fragment, shape.mesh});
        const double area = area_mm2(mesh);
        EXPECT_EQ(count_fragments(mesh, 1e-5).fragments, 1U) << shape.name;
        const FragmentCounts counts = drop_fragments(mesh, 1e-5);
        EXPECT_EQ(counts.faces, fragment.triangles.size()) << shape.name;
        EXPECT_NEAR(counts.area_share, area_mm2(fragment) / area, 1e-12) << shape.name;
        weld(mesh);
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

}  // namespace
}  // namespace qchopper
