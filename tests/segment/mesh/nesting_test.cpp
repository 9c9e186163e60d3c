#include "segment/mesh/nesting.h"

#include <gtest/gtest.h>

#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<std::size_t> depths(const TriangleMesh& mesh) {
    std::vector<std::size_t> result;
    for (const std::vector<std::uint32_t>& around : shells_around(mesh, shells(mesh))) result.push_back(around.size());
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
TEST(Nesting, BoxesOnOneGridAreNoTrouble) {
    const TriangleMesh boxes =
        shapes::joined({shapes::box({-6, -6, -6}, {6, 6, 6}, 12), shapes::box({-2, -2, -2}, {2, 2, 2}, 4),
                        shapes::box({-1, -1, -1}, {1, 1, 1}, 2), shapes::box({3, 3, 3}, {5, 5, 5}, 2)});
    EXPECT_EQ(depths(boxes), (std::vector<std::size_t>{0, 1, 2, 1}));
}

}  // namespace
}  // namespace qchopper
