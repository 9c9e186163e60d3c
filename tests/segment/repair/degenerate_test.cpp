#include "segment/repair/degenerate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::size_t count_without_area(const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) count += is_degenerate(mesh, t);
    return count;
}

// Puts a point in the middle of an edge on one side only; a face without area closes the gap to the other side.
void loosen(TriangleMesh& mesh, std::uint32_t half_edge) {
    Triangle& t = mesh.triangles[half_edge / 3];
    const std::uint32_t k = half_edge % 3;
    const std::uint32_t a = t[k];
    const std::uint32_t c = t[(k + 1) % 3];
    const std::uint32_t x = t[(k + 2) % 3];
    const auto m = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[c]));
    t = {a, m, x};
    mesh.triangles.push_back({m, c, x});
    mesh.triangles.push_back({a, c, m});
}

// Whole coordinates, so that middles are exact.
std::vector<TriangleMesh> exact_shapes() {
    return {shapes::box({-16, -32, -64}, {16, 32, 64}), shapes::box({0, 0, 0}, {64, 64, 64}, 4),
            shapes::pyramid({0, 0, 0}, 16, 64)};
}

TEST(Degenerate, ShapesHaveNone) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const Degenerate counts = remove_degenerate(mesh);
        EXPECT_EQ(counts.flipped + counts.dropped + counts.left, 0U) << shape.name;
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Degenerate, GoesWithoutOpeningTheSurfaceOrMovingAPoint) {
    for (const TriangleMesh& shape : exact_shapes()) {
        for (std::uint32_t h = 0; h < 3 * shape.triangles.size(); h += 5) {
            TriangleMesh mesh = shape;
            loosen(mesh, h);
            ASSERT_EQ(count_without_area(mesh), 1U);
            const TriangleMesh before = mesh;
            const Degenerate counts = remove_degenerate(mesh);
            EXPECT_EQ(counts.flipped, 1U);
            EXPECT_EQ(counts.left, 0U);
            EXPECT_EQ(mesh.points, before.points);
            EXPECT_EQ(mesh.triangles.size(), before.triangles.size());
            EXPECT_EQ(count_without_area(mesh), 0U);
            EXPECT_TRUE(edges(mesh).faults.is_closed());
            EXPECT_DOUBLE_EQ(volume_mm3(mesh), volume_mm3(shape));
        }
    }
}

TEST(Degenerate, RowsOfThemGo) {
    for (const TriangleMesh& shape : exact_shapes()) {
        TriangleMesh mesh = shape;
        loosen(mesh, 0);
        for (int i = 0; i < 4; ++i) loosen(mesh, 0);  // halves the first half again and again
        EXPECT_EQ(count_without_area(mesh), 5U);
        EXPECT_EQ(remove_degenerate(mesh).left, 0U);
        EXPECT_EQ(count_without_area(mesh), 0U);
        EXPECT_TRUE(edges(mesh).faults.is_closed());
        EXPECT_DOUBLE_EQ(volume_mm3(mesh), volume_mm3(shape));
        const TriangleMesh once = mesh;
        remove_degenerate(mesh);
        EXPECT_EQ(mesh, once);
    }
}

TEST(Degenerate, AtABorderItJustGoes) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {2, 0, 0}};
    mesh.triangles = {{0, 3, 2}, {3, 1, 2}, {0, 1, 3}};
    EXPECT_EQ(remove_degenerate(mesh).dropped, 1U);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 3, 2}, {3, 1, 2}}));
}

TEST(Degenerate, IsMarkedAsNew) {
    TriangleMesh mesh = exact_shapes().front();
    loosen(mesh, 0);
    SourceFaces sources{std::vector<std::uint32_t>(mesh.triangles.size(), 5)};
    remove_degenerate(mesh, &sources);
    EXPECT_EQ(count_new(sources), 2U);
}

}  // namespace
}  // namespace qchopper
