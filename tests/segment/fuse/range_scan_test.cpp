// Reading, triangles and lists.

#include <gtest/gtest.h>

#include "base/error.h"
#include "segment/fuse/scan_list.h"
#include "segment/fuse/scan_surface.h"
#include "tests/segment/fuse/views.h"

namespace qchopper {
namespace {

Bytes bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

constexpr std::uint32_t none = RangeScan::no_point;

// Flat, with a spacing of 1; the places that are named are empty.
RangeScan flat_grid(std::size_t columns, std::size_t rows, const std::vector<std::size_t>& empty = {}) {
    RangeScan scan;
    scan.columns = columns;
    scan.rows = rows;
    for (std::size_t i = 0; i < columns * rows; ++i) {
        if (std::find(empty.begin(), empty.end(), i) != empty.end()) {
            scan.grid.push_back(none);
            continue;
        }
        scan.grid.push_back(static_cast<std::uint32_t>(scan.points.size()));
        const auto row = i / columns;
        scan.points.push_back({static_cast<double>(i % columns), static_cast<double>(row), 0});
    }
    return scan;
}

TEST(RangeScan, IsReadAsItIsWritten) {
    const RangeScan scan = flat_grid(4, 3, {0, 6});
    const Bytes bytes = bytes_of(views::ply_of(scan));
    ASSERT_TRUE(is_range_scan(bytes));
    const RangeScan read = parse_range_scan(bytes, "a.ply");
    EXPECT_EQ(read.points, scan.points);
    EXPECT_EQ(read.grid, scan.grid);
    EXPECT_EQ(read.columns, 4U);
    EXPECT_EQ(read.rows, 3U);
    EXPECT_FALSE(is_range_scan(bytes_of("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n")));
    EXPECT_FALSE(is_range_scan(bytes_of("solid range_grid")));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

TEST(RangeScan, WhatIsDamagedIsRefused) {
    const std::string good = views::ply_of(flat_grid(4, 3, {0}));
    const std::vector<std::pair<std::string, std::string>> damaged{
        {replaced(good, "obj_info num_cols 4\n", ""), "num_cols"},
        {replaced(good, "num_rows 3", "num_rows 7"), "4 x 7"},
        {replaced(good, "range_grid 12", "range_grid 4000000000"), "4 x 3"},
        {replaced(good, "1 3\n", "1 99\n"), "not there"},
        {replaced(good, "1 3\n", "1 -3\n"), "line "},
        {replaced(good, "1 3\n", "2 3 4\n"), "several"},
        {replaced(good, "1.000000", "nan"), "line "},
        {good.substr(0, good.size() - 9), "a.ply"}};
    for (const auto& [text, words] : damaged) {
        try {
            parse_range_scan(bytes_of(text), "a.ply");
            FAIL() << words;
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    }
    for (std::size_t length = 0; length < good.size(); length += 7) {
        const Bytes cut = bytes_of(good.substr(0, length));
        if (!is_range_scan(cut)) continue;
        EXPECT_THROW(parse_range_scan(cut, "a.ply"), InputError) << length;
    }
}

TEST(ScanSurface, FourNeighboursGiveTwoTrianglesThreeGiveOne) {
    EXPECT_EQ(triangulate(flat_grid(3, 3), 2).triangles.size(), 8U);
    EXPECT_EQ(triangulate(flat_grid(3, 3, {0}), 2).triangles.size(), 7U);
    EXPECT_EQ(triangulate(flat_grid(3, 3, {0, 1}), 2).triangles.size(), 5U);
    EXPECT_EQ(triangulate(flat_grid(3, 3, {4}), 2).triangles.size(), 4U);
    EXPECT_EQ(triangulate(flat_grid(3, 3), 1.2).triangles.size(), 0U) << "every diagonal is longer";
}

TEST(ScanSurface, TheShorterDiagonalIsTaken) {
    RangeScan scan = flat_grid(2, 2);
    for (const std::size_t raised : {0U, 1U, 2U, 3U}) {
        RangeScan bent = scan;
        bent.points[raised].z = 0.5;
        const TriangleMesh mesh = triangulate(bent, 10);
        ASSERT_EQ(mesh.triangles.size(), 2U);
        // The raised point has the longer diagonal, so it is the corner of one triangle alone.
        const auto uses = std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            return std::find(t.begin(), t.end(), raised) != t.end();
        });
        EXPECT_EQ(uses, 1);
    }
}

TEST(ScanSurface, FacesLookTowardsTheScannerAndBordersAreMarked) {
    for (const bool is_mirrored : {false, true}) {
        RangeScan scan = flat_grid(5, 5);
        if (is_mirrored) {
            for (Vec3& p : scan.points) p.x = -p.x;
        }
        const ScanSurface surface = scan_surface("a", triangulate(scan, 2), true);
        for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) EXPECT_GT(area_vector(surface.mesh, t).z, 0);
        for (std::size_t i = 0; i < 25; ++i) {
            const bool is_border = i < 5 || i >= 20 || i % 5 == 0 || i % 5 == 4;
            EXPECT_EQ(surface.border[i] != 0, is_border) << i;
            EXPECT_EQ(surface.weights[i], is_border ? 0.1F : 1.0F) << i;
        }
    }
    EXPECT_EQ(grid_spacing(flat_grid(5, 5)), 1);
    EXPECT_EQ(grid_spacing(flat_grid(1, 1)), 0);
}

TEST(ScanList, PosesAreRotationsOfBothSigns) {
    const Pose pose = views::turned_about({1, 2, 3}, 0.7, {4, 5, 6});
    const auto listed = parse_scan_list(
        bytes_of("# a comment\ncamera 0 0 0\n" + views::list_line("a.ply", {}) + views::list_line("b.ply", pose)), "l");
    ASSERT_EQ(listed.size(), 2U);
    EXPECT_EQ(listed[0].pose, Pose());
    EXPECT_EQ(listed[1].file, "b.ply");
    EXPECT_LT(views::angle_of(inverse(pose) * listed[1].pose), 1e-5);
    EXPECT_LT(norm(listed[1].pose.shift - pose.shift), 1e-5);
    // The opposite sign of the real part is the inverse rotation.
    EXPECT_LT(views::angle_of(pose * Pose{listed[1].other.row, {}}), 1e-5);
}

TEST(ScanList, WhatIsNoListIsRefusedWithItsLine) {
    const std::string good = views::list_line("a.ply", {});
    const std::vector<std::pair<std::string, std::string>> faults{
        {"", "fewer than two"},
        {good, "fewer than two"},
        {good + "bmesh b.ply\n", "line 2"},
        {good + "bmesh b.ply 0 0 0 0 0 0\n", "line 2"},
        {good + "bmesh b.ply 0 0 0 0 0 0 0.5\n", "no rotation"},
        {good + "bmesh b.ply 0 0 0 0 0 0 nan\n", "line 2"},
        {good + "bmesh b.ply 0 0 x 0 0 0 1\n", "\"x\""},
        {good + "\n" + good, "line 3: a.ply is listed twice"}};
    for (const auto& [text, words] : faults) {
        try {
            parse_scan_list(bytes_of(text), "scans.conf");
            FAIL() << words;
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find("scans.conf"), 0U);
        }
    }
}

}  // namespace
}  // namespace qchopper
