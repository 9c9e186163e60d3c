#include "app/engine/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

bool is_less(Vec3 a, Vec3 b) {
    return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
}

// The points that the cut's caps have.
std::vector<Vec3> cap_points(const CutHalves& halves) {
    std::vector<Vec3> points;
    const TriangleMesh& mesh = halves.above.mesh;
    std::vector<bool> is_cap(mesh.points.size(), false);
    for (std::size_t t = halves.above.first_cap_triangle; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) is_cap[v] = true;
    }
    for (std::size_t v = 0; v < is_cap.size(); ++v) {
        if (is_cap[v]) points.push_back(mesh.points[v]);
    }
    return points;
}

TEST(Outline, HasTheLoopsPointsAndAreaOfTheCutOnEveryShape) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(mesh);
        for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{-2, 1, 0.3}}) {
            const Vec3 n = canonical({direction, 0}).normal;
            const Extent range = extent(mesh, n);
            const std::vector<double> wanted{range.low + 0.21 * range.size(), range.low + 0.5 * range.size(),
                                             range.low + 0.83 * range.size()};
            for (const auto& nudged : nudge(piece, n, wanted)) {
                if (!nudged) continue;
                const Plane plane{n, nudged->offset};
                const std::optional<CutHalves> halves = cut(mesh, plane, 1);
                const Outline found = outline(mesh, plane);
                EXPECT_EQ(found.loops.empty(), !halves.has_value()) << name;
                if (!halves) continue;  // between two balls
                EXPECT_EQ(found.loops.size(), halves->loops) << name;
                std::vector<Vec3> points;
                double area = 0;
                for (const auto& loop : found.loops) {
                    for (std::size_t i = 0; i < loop.size(); ++i) {
                        points.push_back(loop[i]);
                        area += 0.5 * dot(n, cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]));
                    }
                }
                EXPECT_NEAR(area, halves->cap_area_mm2, 1e-9 * range.size() * range.size()) << name;
                std::vector<Vec3> caps = cap_points(*halves);
                std::sort(points.begin(), points.end(), is_less);
                std::sort(caps.begin(), caps.end(), is_less);
                EXPECT_EQ(points, caps) << name;
            }
        }
    }
}

TEST(Outline, MeasuresItsLengthAndBox) {
    const Outline of_box = outline(shapes::box({0, 0, 0}, {10, 20, 30}), {{0, 0, 1}, 7});
    ASSERT_EQ(of_box.loops.size(), 1U);
    EXPECT_NEAR(of_box.length_mm, 60, 1e-9);
    EXPECT_EQ(of_box.box, (Box{{0, 0, 7}, {10, 20, 7}}));
    const Outline of_ball = outline(shapes::ball({0, 0, 0}, 10, 64), {{0, 0, 1}, 0.01});
    EXPECT_NEAR(of_ball.length_mm, 20 * std::numbers::pi, 0.1);
}

TEST(Outline, OfAPlaneThatMissesIsEmpty) {
    EXPECT_TRUE(outline(shapes::ball({0, 0, 0}, 10), {{0, 0, 1}, 11}).loops.empty());
}

}  // namespace
}  // namespace qchopper
