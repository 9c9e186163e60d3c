#include "segment/mesh/connectivity/containment.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"
#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Inside, AnInteriorPointLiesInItsSolidAndInNoOther) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Segmentation segmentation = uncut(mesh, 0);
        for (const Piece& piece : segmentation.pieces) {
            const std::optional<Vec3> point = interior_point(*piece.mesh);
            ASSERT_TRUE(point) << name;
            for (const Piece& other : segmentation.pieces) {
                EXPECT_EQ(is_inside(*other.mesh, *point), other.name == piece.name) << name << " " << piece.name;
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
                    EXPECT_TRUE(is_inside(ball, {x, y, z}));
                } else if (far > 10) {
                    EXPECT_FALSE(is_inside(ball, {x, y, z}));
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
                EXPECT_EQ(is_inside(box, {x, y, 2.1}), is_in) << x << " " << y;
            }
        }
    }
}

TEST(Inside, AnInteriorPointIsFarFromTheSurface) {
    const Vec3 of_ball = *interior_point(shapes::ball({3, -2, 5}, 10, 20));
    EXPECT_LT(norm(of_ball - Vec3{3, -2, 5}), 1);
    const Vec3 of_slab = *interior_point(shapes::box({0, 0, 0}, {100, 100, 1}));
    EXPECT_NEAR(of_slab.z, 0.5, 1e-9);
    EXPECT_NEAR(of_slab.x, 50, 1e-9);
}

TEST(Inside, ThereIsNoneWithoutAVolume) {
    TriangleMesh flat = shapes::box({0, 0, 0}, {10, 10, 10});
    for (Vec3& p : flat.points) p.z = 0;
    EXPECT_FALSE(interior_point(flat));
    EXPECT_FALSE(interior_point(TriangleMesh{}));
}

std::vector<std::size_t> depths(const TriangleMesh& mesh) {
    std::vector<std::size_t> result;
    for (const std::span<const std::uint32_t> around : shells_around(mesh, shells(mesh)))
        result.push_back(around.size());
    return result;
}

TEST(Nesting, CountsTheShellsAroundEachShell) {
    const TriangleMesh dolls =
        shapes::joined({shapes::ball({0, 0, 0}, 10), shapes::ball({0, 0, 0}, 8), shapes::ball({3, 0, 0}, 2),
                        shapes::ball({-3, 0, 0}, 2), shapes::ball({30, 0, 0}, 2)});
    EXPECT_EQ(depths(dolls), (std::vector<std::size_t>{0, 1, 2, 2, 0}));
}

TEST(Nesting, DoesNotDependOnOrientationOrPlace) {
    const TriangleMesh inner = shapes::turned_inside_out(shapes::ball({1, 2, 3}, 4));
    for (const Vec3 by : {Vec3{0, 0, 0}, Vec3{100, -50, 7}}) {
        const TriangleMesh both = shapes::moved(shapes::joined({inner, shapes::box({-9, -9, -9}, {9, 9, 9}, 3)}), by);
        EXPECT_EQ(depths(both), (std::vector<std::size_t>{1, 0}));
        EXPECT_EQ(depths(shapes::rotated(both, {1, 2, 3}, 1)), (std::vector<std::size_t>{1, 0}));
        EXPECT_EQ(depths(shapes::turned_inside_out(both)), (std::vector<std::size_t>{1, 0}));
    }
}

TEST(Nesting, ABallInTheHoleOfARingIsNotInTheRing) {
    const TriangleMesh both = shapes::joined({shapes::torus({0, 0, 0}, 10, 3), shapes::ball({0, 0, 0}, 4)});
    EXPECT_EQ(depths(both), (std::vector<std::size_t>{0, 0}));
    const TriangleMesh inside = shapes::joined({shapes::torus({0, 0, 0}, 10, 3), shapes::ball({10, 0, 0}, 1)});
    EXPECT_EQ(depths(inside), (std::vector<std::size_t>{0, 1}));
}

// Everything on one grid: rays pass through edges and corners of the other boxes all the time.
TEST(Nesting, HandlesBoxesOnOneGrid) {
    const TriangleMesh boxes =
        shapes::joined({shapes::box({-6, -6, -6}, {6, 6, 6}, 12), shapes::box({-2, -2, -2}, {2, 2, 2}, 4),
                        shapes::box({-1, -1, -1}, {1, 1, 1}, 2), shapes::box({3, 3, 3}, {5, 5, 5}, 2)});
    EXPECT_EQ(depths(boxes), (std::vector<std::size_t>{0, 1, 2, 1}));
}

}  // namespace
}  // namespace qchopper
