// Marks that go from a painted scan to a repaired one.

#include "segment/import/map_painted.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/repair.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The half above a height is painted.
TriangleMesh painted_above(TriangleMesh mesh, double z) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto p = corners_of(mesh, t);
        mesh.ignored.push_back(p[0].z + p[1].z + p[2].z > 3 * z ? 1 : 0);
    }
    return mesh;
}

// As an STL file holds it, without the triangles near a point.
TriangleMesh unwelded_with_hole(const TriangleMesh& mesh, Vec3 at, double radius) {
    TriangleMesh loose;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto p = corners_of(mesh, t);
        if (norm((1.0 / 3) * (p[0] + p[1] + p[2]) - at) < radius) continue;
        const auto first = static_cast<std::uint32_t>(loose.points.size());
        loose.points.insert(loose.points.end(), p.begin(), p.end());
        loose.triangles.push_back({first, first + 1, first + 2});
    }
    return loose;
}

TEST(MapPainted, LandsOnTheRightFacesAfterARepair) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 24);
    const TriangleMesh scan = unwelded_with_hole(ball, {0, 0, 50}, 14);  // the hole lies in the painted half
    const TriangleMesh painted = painted_above(scan, 0);
    const Repaired repaired = repair(scan, {});
    ASSERT_TRUE(edges(repaired.mesh).faults.is_closed());
    ASSERT_GT(repaired.report.holes_filled, 0U);
    const std::vector<std::uint8_t> marks = mapped_marks(painted, repaired.mesh);
    ASSERT_EQ(marks.size(), repaired.mesh.triangles.size());
    const TriangleMesh wanted = painted_above(repaired.mesh, 0);
    EXPECT_EQ(marks, wanted.ignored);
    EXPECT_EQ(share_off_scan(painted, repaired.mesh, 0.1), 0);
}

TEST(MapPainted, PointsTakeTheMarkOfTheNearestVertex) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 24);
    std::vector<std::uint8_t> is_marked;
    for (const Vec3& p : ball.points) is_marked.push_back(p.z > 10 ? 1 : 0);
    const auto above = [](const TriangleMesh& mesh, double z) {
        std::vector<Vec3> points;
        for (const Vec3& p : mesh.points) {
            if (p.z > z) points.push_back(p);
        }
        return points;
    };
    EXPECT_EQ(mapped_points(ball, is_marked, ball), above(ball, 10)) << "of the same surface exactly";
    const TriangleMesh other = shapes::ball({0, 0, 0}, 50, 40);
    const std::vector<Vec3> mapped = mapped_points(ball, is_marked, other);
    EXPECT_LE(mapped.size(), above(other, 6).size());
    EXPECT_GE(mapped.size(), above(other, 14).size());
    for (const Vec3& p : mapped) EXPECT_GT(p.z, 6);
    const ThreadLimit one(1);
    EXPECT_EQ(mapped_points(ball, is_marked, other), mapped);
}

TEST(MapPainted, KnowsAnotherSurface) {
    const TriangleMesh ball = painted_above(shapes::ball({0, 0, 0}, 50, 24), 0);
    EXPECT_EQ(share_off_scan(ball, shapes::ball({0, 0, 0}, 50, 40), 1), 0) << "other triangles of one surface";
    EXPECT_EQ(share_off_scan(ball, shapes::ball({0, 0, 0}, 60, 24), 1), 1);
    const double off = share_off_scan(ball, shapes::ball({3, 0, 0}, 50, 24), 1);
    EXPECT_GT(off, 0.5);
    EXPECT_LT(off, 0.9) << "surface along the shift stays near";
}

TEST(MapPainted, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh painted = painted_above(shapes::ball({0, 0, 0}, 50, 60), 3);
    const TriangleMesh scan = shapes::ball({0, 0, 0}, 50, 47);
    const std::vector<std::uint8_t> all = mapped_marks(painted, scan);
    const ThreadLimit one(1);
    EXPECT_EQ(mapped_marks(painted, scan), all);
    EXPECT_EQ(mapped_marks(painted, {}), std::vector<std::uint8_t>{});
}

}  // namespace
}  // namespace qchopper
