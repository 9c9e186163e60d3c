
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The shape in two halves, those of its triangles left and right of its middle, with a gap between them.
TriangleMesh torn(const TriangleMesh& mesh, double gap) {
    TriangleMesh left = mesh;
    TriangleMesh right = shapes::moved(mesh, {gap, 0, 0});
    const double middle = bounds(mesh).centre().x;
    const auto is_left = [&](const Triangle& t) {
        return mesh.points[t[0]].x + mesh.points[t[1]].x + mesh.points[t[2]].x < 3 * middle;
    };
    std::erase_if(left.triangles, [&](const Triangle& t) { return !is_left(t); });
    std::erase_if(right.triangles, is_left);
    TriangleMesh both = shapes::joined({left, right});
    weld(both);
    return both;
}

TEST(SnapBorders, ClosesATornShape) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = torn(shape.mesh, 0.01);
        if (edges(mesh).faults.is_closed()) continue;  // two solids, one on each side
        const SnapBorders counts = snap_borders(mesh, 0.02);
        EXPECT_GT(counts.welded, 0U) << shape.name;
        EXPECT_NEAR(counts.farthest, 0.01, 1e-6) << shape.name;
        EXPECT_TRUE(edges(mesh).faults.is_closed()) << shape.name;
        EXPECT_EQ(mesh.triangles.size(), shape.mesh.triangles.size()) << shape.name;
        const TriangleMesh once = mesh;
        snap_borders(mesh, 0.02);
        EXPECT_EQ(mesh, once) << shape.name;
    }
}

TEST(SnapBorders, LeavesAWiderGapAndClosedShapesAlone) {
    const TriangleMesh open = torn(shapes::ball({0, 0, 0}, 25), 0.01);
    TriangleMesh mesh = open;
    EXPECT_EQ(snap_borders(mesh, 0.005).welded, 0U);
    EXPECT_EQ(mesh, open);
    EXPECT_EQ(snap_borders(mesh, 0).welded, 0U);
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh closed = shape.mesh;
        EXPECT_EQ(snap_borders(closed, 1000).welded, 0U);
        EXPECT_EQ(closed, shape.mesh) << shape.name;
    }
}

TEST(SnapBorders, MovesNoPointFartherThanTheToleranceAndCollapsesNoFace) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 10);
    for (const double tolerance : {0.1, 0.5, 2.0}) {
        TriangleMesh soup;
        for (std::uint32_t t = 0; t < 300; ++t) {
            const Vec3 p{place(random), place(random), place(random)};
            soup.points.insert(soup.points.end(), {p, p + Vec3{1, 0, 0}, p + Vec3{0, 1, 0.3}});
            soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
        TriangleMesh mesh = soup;
        const SnapBorders counts = snap_borders(mesh, tolerance);
        EXPECT_LE(counts.farthest, tolerance);
        EXPECT_EQ(mesh.triangles.size(), soup.triangles.size());
        EXPECT_EQ(mesh.points.size(), soup.points.size() - counts.welded);
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_LE(norm(mesh.points[mesh.triangles[t][i]] - soup.points[soup.triangles[t][i]]), tolerance);
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
