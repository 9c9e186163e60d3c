#include "segment/mesh/inside.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"
#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Inside, ADeepPointLiesInItsSolidAndInNoOther) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Segmentation segmentation = uncut(mesh, 0);
        for (const Piece& piece : segmentation.pieces) {
            const std::optional<Vec3> point = deep_point(*piece.mesh);
            ASSERT_TRUE(point) << name;
            for (const Piece& other : segmentation.pieces) {
                EXPECT_EQ(contains(*other.mesh, *point), other.name == piece.name) << name << " " << piece.name;
            }
        }
    }
}

TEST(Inside, OfTheBallIsNearerThanItsRadius) {
    const TriangleMesh ball = shapes::ball({3, -2, 5}, 10, 20);
    for (double x = -10; x < 17; x += 0.93) {
        for (double y = -14; y < 10; y += 1.07) {
            for (double z = -6; z < 17; z += 1.01) {
                const double far = norm(Vec3{x, y, z} - Vec3{3, -2, 5});
                if (far < 9.7) {
                    EXPECT_TRUE(contains(ball, {x, y, z}));
                } else if (far > 10) {
                    EXPECT_FALSE(contains(ball, {x, y, z}));
                }
            }
        }
    }
}

TEST(Inside, LinesThroughVerticesAndAlongEdgesCountRight) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {4, 4, 4}, 4);  // vertices and diagonals at whole coordinates
    for (double x = -1; x <= 5; x += 0.5) {
        for (double y = -1; y <= 5; y += 0.5) {
            const bool is_in = x > 0 && x < 4 && y > 0 && y < 4;
            const bool is_out = x < 0 || x > 4 || y < 0 || y > 4;
            if (is_in || is_out) {
                EXPECT_EQ(contains(box, {x, y, 2.1}), is_in) << x << " " << y;
            }
        }
    }
}

TEST(Inside, ADeepPointIsFarFromTheSurface) {
    const Vec3 of_ball = *deep_point(shapes::ball({3, -2, 5}, 10, 20));
    EXPECT_LT(norm(of_ball - Vec3{3, -2, 5}), 1);
    const Vec3 of_slab = *deep_point(shapes::box({0, 0, 0}, {100, 100, 1}));
    EXPECT_NEAR(of_slab.z, 0.5, 1e-9);
    EXPECT_NEAR(of_slab.x, 50, 1e-9);
}

TEST(Inside, ThereIsNoneWithoutAVolume) {
    TriangleMesh flat = shapes::box({0, 0, 0}, {10, 10, 10});
    for (Vec3& p : flat.points) p.z = 0;
    EXPECT_FALSE(deep_point(flat));
    EXPECT_FALSE(deep_point(TriangleMesh{}));
}

}  // namespace
}  // namespace qchopper
