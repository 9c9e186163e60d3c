#include "segment/mesh/oriented_box.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

void expect_frame(const OrientedBox& box) {
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(norm(box.axis[i]), 1, 1e-9);
        EXPECT_NEAR(dot(box.axis[i], box.axis[(i + 1) % 3]), 0, 1e-9);
    }
    EXPECT_GT(dot(cross(box.axis[0], box.axis[1]), box.axis[2]), 0.999);
}

TEST(OrientedBox, HoldsEveryPointOfEveryShape) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const OrientedBox box = oriented_box(mesh.points);
        expect_frame(box);
        for (const Vec3& p : mesh.points) {
            for (int k = 0; k < 3; ++k) {
                const double at = dot(box.axis[static_cast<std::size_t>(k)], p);
                ASSERT_GE(at, box.min[k]) << name;
                ASSERT_LE(at, box.max[k]) << name;
            }
        }
    }
}

TEST(OrientedBox, FindsATurnedBoxAgain) {
    const TriangleMesh mesh = shapes::rotated(shapes::box({0, 0, 0}, {30, 20, 10}, 4), {1, 2, 3}, 0.7);
    const Vec3 size = oriented_box(mesh.points).size();
    EXPECT_NEAR(size.x, 30, 0.3);
    EXPECT_NEAR(size.y, 20, 0.3);
    EXPECT_NEAR(size.z, 10, 0.3);
}

TEST(OrientedBox, IsTheSameTwice) {
    const TriangleMesh mesh = shapes::linked_tori();
    const OrientedBox a = oriented_box(mesh.points);
    const OrientedBox b = oriented_box(mesh.points);
    EXPECT_EQ(a.axis, b.axis);
    EXPECT_EQ(a.min, b.min);
}

TEST(OrientedBox, TakesTheWorldsAxesForFlatOrFewPoints) {
    const std::vector<Vec3> flat{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {2, 1, 0}};
    EXPECT_EQ(oriented_box(flat).size(), (Vec3{4, 3, 0}));
    expect_frame(oriented_box(std::vector<Vec3>{{1, 2, 3}}));
}

}  // namespace
}  // namespace qchopper
