#include "segment/mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(TriangleTree, FindsEveryTriangleWhoseBoxIsNear) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-12, 12);
    for (const Vec3 by : {Vec3{}, Vec3{1e6, 1e6, 1e6}}) {
        for (const shapes::Named& shape : shapes::all_closed()) {
            const TriangleMesh mesh = shapes::moved(shape.mesh, by);
            const TriangleTree tree(mesh);
            for (int i = 0; i < 20; ++i) {
                const auto point = [&] { return by + Vec3{place(random), place(random), place(random)}; };
                const FloatBox box = tree.box_of({point(), point(), point()});
                std::vector<std::uint32_t> near;
                tree.for_each_near(box, [&](std::uint32_t t) { near.push_back(t); });
                std::sort(near.begin(), near.end());
                std::vector<std::uint32_t> expected;
                for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                    if (do_meet(tree.box_of(corners_of(mesh, t)), box)) expected.push_back(t);
                }
                EXPECT_EQ(near, expected) << shape.name;
            }
        }
    }
}

TEST(TriangleTree, FindsTheNearestPoint) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-12, 12);
    for (const shapes::Named& shape : shapes::all_closed()) {
        const TriangleTree tree(shape.mesh);
        for (int i = 0; i < 30; ++i) {
            const Vec3 p{place(random), place(random), place(random)};
            double expected = std::numeric_limits<double>::infinity();
            for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
                expected = std::min(expected, norm(closest_on_triangle(p, corners_of(shape.mesh, t)) - p));
            }
            const TriangleTree::Nearest found = tree.nearest(shape.mesh, p);
            EXPECT_DOUBLE_EQ(found.distance, expected) << shape.name;
            EXPECT_DOUBLE_EQ(norm(found.point - p), expected) << shape.name;
            const TriangleTree::Nearest enough = tree.nearest(shape.mesh, p, 1.5 * expected);
            EXPECT_LE(enough.distance, 1.5 * expected) << shape.name;
            EXPECT_DOUBLE_EQ(norm(enough.point - p), enough.distance) << shape.name;
            EXPECT_DOUBLE_EQ(tree.nearest(shape.mesh, p, 0.99 * expected).distance, expected) << shape.name;
        }
    }
}

TEST(TriangleTree, KnowsWhetherAnythingIsNearer) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-12, 12);
    for (const Vec3 by : {Vec3{}, Vec3{1e6, 1e6, 1e6}}) {
        for (const shapes::Named& shape : shapes::all_closed()) {
            const TriangleMesh mesh = shapes::moved(shape.mesh, by);
            const TriangleTree tree(mesh);
            std::vector<bool> is_left_out;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) is_left_out.push_back(random() % 3 == 0);
            for (int i = 0; i < 30; ++i) {
                const Vec3 p = by + Vec3{place(random), place(random), place(random)};
                for (const std::vector<bool>& left_out : {std::vector<bool>(), is_left_out}) {
                    double nearest = std::numeric_limits<double>::infinity();
                    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                        if (!left_out.empty() && left_out[t]) continue;
                        nearest = std::min(nearest, norm(closest_on_triangle(p, corners_of(mesh, t)) - p));
                    }
                    for (const double share : {0.0, 0.5, 1 - 1e-12}) {
                        EXPECT_FALSE(tree.is_any_nearer(mesh, p, share * nearest, left_out)) << shape.name;
                    }
                    for (const double share : {1 + 1e-12, 1.5, 100.0}) {
                        EXPECT_TRUE(tree.is_any_nearer(mesh, p, share * nearest, left_out)) << shape.name;
                    }
                }
            }
        }
    }
    EXPECT_FALSE(TriangleTree(TriangleMesh{}).is_any_nearer({}, {}, 1));
}

// No point of a fine grid of the triangle is nearer than the closest one.
TEST(TriangleTree, ClosestPointOfATriangleIsClosest) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 1);
    const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
    for (int i = 0; i < 500; ++i) {
        const std::array<Vec3, 3> t{point(), point(), point()};
        const Vec3 p = point();
        const double found = norm(closest_on_triangle(p, t) - p);
        double best = std::numeric_limits<double>::infinity();
        for (int u = 0; u <= 40; ++u) {
            for (int v = 0; u + v <= 40; ++v) {
                const Vec3 q = t[0] + (u / 40.0) * (t[1] - t[0]) + (v / 40.0) * (t[2] - t[0]);
                best = std::min(best, norm(q - p));
            }
        }
        EXPECT_LE(found, best + 1e-12);
        EXPECT_GE(found, best - 0.1);
    }
}

TEST(TriangleTree, OfNothingFindsNothing) {
    const TriangleMesh nothing;
    EXPECT_TRUE(std::isinf(TriangleTree(nothing).nearest(nothing, {}).distance));
}

}  // namespace
}  // namespace qchopper
