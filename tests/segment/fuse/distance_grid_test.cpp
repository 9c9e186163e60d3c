#include "segment/fuse/distance_grid.h"

#include <gtest/gtest.h>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// A flat grid of 21 x 21 points, 1 apart, at a height, seen from above.
ScanSurface flat_scan(double height) {
    RangeScan scan;
    scan.columns = scan.rows = 21;
    for (std::uint32_t i = 0; i < 21 * 21; ++i) {
        scan.grid.push_back(i);
        const std::uint32_t row = i / 21;
        scan.points.push_back({i % 21 * 1.0, row * 1.0, height});
    }
    return scan_surface("flat", triangulate(scan, 2), true);
}

const std::vector<Pose> two_poses(2);

constexpr double margin = 0.081;  // that a point keeps from the ends of its lattice edge

TEST(DistanceGrid, OneScanIsItsOwnSurface) {
    const std::vector<ScanSurface> scans{flat_scan(0)};
    const TriangleMesh mesh = merge_scans(scans, std::vector<Pose>(1), 1);
    ASSERT_FALSE(mesh.triangles.empty());
    for (const Vec3& p : mesh.points) EXPECT_NEAR(p.z, 0, margin);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(area_vector(mesh, t).z, 0);
    // It ends at the border of what was seen, about a cell before it or behind it.
    EXPECT_NEAR(area_mm2(mesh), 400, 80);
}

TEST(DistanceGrid, TwoScansGiveTheirMean) {
    const std::vector<ScanSurface> scans{flat_scan(0), flat_scan(0.4)};
    for (const Vec3& p : merge_scans(scans, two_poses, 1).points) EXPECT_NEAR(p.z, 0.2, margin);
}

TEST(DistanceGrid, WhatIsFartherApartThanTheReachStaysApart) {
    const std::vector<ScanSurface> scans{flat_scan(0), flat_scan(10)};
    const Box box = bounds(merge_scans(scans, two_poses, 1));
    EXPECT_NEAR(box.min.z, 0, margin);
    EXPECT_NEAR(box.max.z, 10, margin);
}

TEST(DistanceGrid, NothingGivesNothing) {
    ScanSurface none = flat_scan(0);
    none.mesh.triangles.clear();
    none.open.clear();
    EXPECT_TRUE(merge_scans(std::vector<ScanSurface>{none}, std::vector<Pose>(1), 1).triangles.empty());
}

}  // namespace
}  // namespace qchopper
