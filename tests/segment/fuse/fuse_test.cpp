// Ten views of a known surface, made by casting rays, become that surface again.

#include "segment/fuse/fuse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/fuse/align.h"
#include "segment/fuse/scan_surface.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/sample/sample.h"
#include "tests/folder.h"
#include "tests/segment/fuse/views.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

const TriangleMesh& vertebra() {
    static const TriangleMesh mesh = sample(Specimen::vertebra, {20'000, 0});
    return mesh;
}

constexpr double spacing = 2.5;

std::vector<RangeScan> ten_views(const TriangleMesh& mesh, double spacing_mm) {
    const RayTree tree(mesh);
    std::vector<RangeScan> scans;
    views::ViewOptions options{spacing_mm};
    for (const Pose& pose : views::ten_poses()) {
        scans.push_back(view_of(mesh, tree, pose, options));
        ++options.seed;
    }
    return scans;
}

// Poses that are off by an angle about some axis and a shift; the first one is right.
std::vector<Pose> disturbed(const std::vector<Pose>& poses, Vec3 centre, double angle, double shift) {
    std::mt19937 random(7);
    std::normal_distribution<double> value;
    std::vector<Pose> off{poses.front()};
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const Pose turn = views::turned_about({value(random), value(random), value(random)}, angle);
        const Vec3 by = shift * normalized({value(random), value(random), value(random)});
        off.push_back(Pose{turn.row, centre - rotate(turn, centre) + by} * poses[i]);
    }
    return off;
}

// Writes scans and their list into a folder.
fs::path written(const fs::path& folder, const std::vector<RangeScan>& scans, const std::vector<Pose>& poses,
                 double sign = 1) {
    std::ofstream list(folder / "scans.conf");
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const std::string name = "view" + std::to_string(i) + ".ply";
        std::ofstream(folder / name) << views::ply_of(scans[i]);
        list << views::list_line(name, poses[i], sign);
    }
    return folder / "scans.conf";
}

struct Distances {
    double largest = 0;
    double mean = 0;
};

// From every few of these points to a surface.
Distances distances(const std::vector<Vec3>& points, const TriangleMesh& surface) {
    const TriangleTree tree(surface);
    const std::size_t step = points.size() / 20'000 + 1;
    Distances found;
    double count = 0;
    for (std::size_t i = 0; i < points.size(); i += step) {
        const double distance = tree.nearest(surface, points[i]).distance;
        found.largest = std::max(found.largest, distance);
        found.mean += distance;
        ++count;
    }
    found.mean /= count;
    return found;
}

// The points of scans that were seen at less than 70 degrees and have triangles around them, on the surface.
std::vector<Vec3> seen_points(const std::vector<RangeScan>& scans, const std::vector<Pose>& poses,
                              const TriangleMesh& surface) {
    const double least = std::cos(70 * std::numbers::pi / 180);
    const TriangleTree tree(surface);
    std::vector<Vec3> seen;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        const ScanSurface scan = scan_surface("", triangulate(scans[s], 4 * spacing), true);
        for (std::size_t i = 0; i < scan.mesh.points.size(); ++i) {
            if (scan.border[i] != 0 || norm(scan.normals[i]) == 0) continue;
            const auto nearest = tree.nearest(surface, apply(poses[s], scan.mesh.points[i]));
            const Vec3 normal = normalized(area_vector(surface, nearest.triangle));
            if (dot(normal, rotate(poses[s], {0, 0, 1})) > least) seen.push_back(nearest.point);
        }
    }
    return seen;
}

// How far each pose is off from the right one: the angle in radians, and the distance at a point.
std::vector<std::pair<double, double>> errors(const std::vector<Pose>& found, const std::vector<Pose>& right,
                                              Vec3 centre) {
    std::vector<std::pair<double, double>> off;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Pose error = found[i] * inverse(right[i]);
        off.emplace_back(views::angle_of(error), norm(apply(error, centre) - centre));
    }
    return off;
}

TEST(Align, PosesThatAreOffByFiveDegreesAndFiveMillimetresComeBack) {
    const std::vector<Pose> right = views::ten_poses();
    const Vec3 centre = bounds(vertebra()).centre();
    std::vector<ScanSurface> surfaces;
    for (const RangeScan& scan : ten_views(vertebra(), spacing)) {
        surfaces.push_back(scan_surface("view", triangulate(scan, 4 * spacing), true));
    }
    const std::vector<Pose> off = disturbed(right, centre, 5 * std::numbers::pi / 180, 5);
    AlignOptions options;
    options.spacing = spacing;
    const Alignment alignment = align(surfaces, off, options);
    std::vector<Pose> found;
    for (const AlignedScan& scan : alignment.scans) found.push_back(scan.pose);
    std::vector<std::pair<double, double>> error = errors(found, right, centre);
    constexpr double degree = std::numbers::pi / 180;
    for (const auto& [angle, distance] : error) {
        EXPECT_LT(angle, 0.1 * degree);
        EXPECT_LT(distance, 0.2);
    }
    std::sort(error.begin(), error.end());
    EXPECT_LT(error[error.size() / 2].first, 0.05 * degree);
    std::sort(error.begin(), error.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    EXPECT_LT(error[error.size() / 2].second, 0.1);
    EXPECT_EQ(error.front().second, 0) << "the first scan is fixed";
}

TEST(Fuse, TenViewsBecomeTheSurfaceAgain) {
    const Folder folder;
    const std::vector<Pose> poses = views::ten_poses();
    const std::vector<RangeScan> scans = ten_views(vertebra(), spacing);
    const fs::path list =
        written(folder.path, scans, disturbed(poses, bounds(vertebra()).centre(), 2 * std::numbers::pi / 180, 2));
    const Fused fused = fuse(list);
    const double voxel = fused.report.voxel;
    EXPECT_NEAR(voxel, spacing, 0.2 * spacing);
    EXPECT_FALSE(fused.report.is_other_sign);
    ASSERT_EQ(fused.report.scans.size(), 10U);
    for (const FusedScan& scan : fused.report.scans) EXPECT_TRUE(scan.fits) << scan.file;
    EXPECT_LT(fused.report.missing_share, 0.05);
    const Distances there = distances(fused.mesh.points, vertebra());
    EXPECT_LT(there.largest, 3 * voxel);
    EXPECT_LT(there.mean, 0.3 * voxel);
    const Distances back = distances(seen_points(scans, poses, vertebra()), fused.mesh);
    EXPECT_LT(back.largest, 3 * voxel);
    EXPECT_LT(back.mean, 0.3 * voxel);
    // Faces look outwards.
    double agree = 0;
    const TriangleTree tree(vertebra());
    double asked = 0;
    for (std::size_t t = 0; t < fused.mesh.triangles.size(); t += 50) {
        const auto nearest = tree.nearest(vertebra(), corners_of(fused.mesh, t)[0]);
        agree += dot(area_vector(fused.mesh, t), area_vector(vertebra(), nearest.triangle)) > 0 ? 1 : 0;
        ++asked;
    }
    EXPECT_GT(agree, 0.98 * asked);
}

TEST(Fuse, TheSignOfTheListIsFoundAndThreadsChangeNothing) {
    const Folder folder;
    const fs::path list = written(folder.path, ten_views(vertebra(), 8), views::ten_poses(), -1);
    const Fused fused = fuse(list);
    EXPECT_TRUE(fused.report.is_other_sign);
    EXPECT_LT(distances(fused.mesh.points, vertebra()).mean, 0.3 * fused.report.voxel);
    const ThreadLimit one(1);
    EXPECT_EQ(fuse(list).mesh, fused.mesh);
}

TEST(Fuse, AScanThatOverlapsNoOtherIsNamed) {
    const Folder folder;
    std::vector<Pose> poses = views::ten_poses();
    poses[4].shift = {5000, 0, 0};
    const fs::path list = written(folder.path, ten_views(vertebra(), 8), poses);
    try {
        fuse(list);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        EXPECT_NE(std::string(error.what()).find("view4.ply"), std::string::npos) << error.what();
    }
}

TEST(Fuse, WhatIsMissingOrNoLengthIsRefused) {
    const Folder folder;
    const fs::path list = written(folder.path, ten_views(vertebra(), 12), views::ten_poses());
    for (const double voxel : {0.0, -1.0, std::numeric_limits<double>::infinity(), 1e-6}) {
        EXPECT_THROW(fuse(list, {voxel}), InputError) << voxel;
    }
    fs::remove(folder.path / "view3.ply");
    try {
        fuse(list);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::missing);
    }
    EXPECT_THROW(fuse(folder.path / "none.conf"), InputError);
}

TEST(Fuse, TheTwoRealScansOfTheBunnyLieTogether) {
    const fs::path list = fs::path(QCHOPPER_MESHES) / "range" / "bun.conf";
    if (!fs::exists(list)) GTEST_SKIP() << "no range scans";
    const Fused fused = fuse(list);
    EXPECT_LE(1000 * fused.report.residual, 0.35) << "mm";
    const TriangleMesh bunny = read_mesh(list.parent_path().parent_path() / "bunny_bun_zipper.ply").mesh;
    const Distances there = distances(fused.mesh.points, bunny);
    EXPECT_LT(there.mean, fused.report.voxel);
    EXPECT_GT(fused.report.missing_share, 0.1) << "seen from two sides";
}

}  // namespace
}  // namespace qchopper
