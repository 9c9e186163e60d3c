// The poses of a setup: on the piece, at the block, above them, and how they hang together.

#include "cam/setup/placement/milling_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/cam/setup/random_setups.h"

namespace qchopper {
namespace {

using test_setups::box_setup;
using test_setups::BoxSetup;
using test_setups::tool_axis;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

std::size_t count(const OrientationPoses& orientation, PoseKind kind) {
    std::size_t found = 0;
    for (const PoseRegion& region : orientation.regions) {
        found += static_cast<std::size_t>(std::count_if(region.poses.begin(), region.poses.end(),
                                                        [&](const MillingPose& p) { return p.kind == kind; }));
    }
    return found;
}

TEST(MillingPoses, LieOnThePieceAtTheBlockAndAbove) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const BoxSetup s = box_setup(cell, {400, 200, 120}, {{0, 0, 1}, tool_axis(30, 0)});
    const std::vector<OrientationPoses> all = milling_poses(s.setup, s.mesh, cell);
    ASSERT_EQ(all.size(), 2U);
    const double top = s.setup.block.size.z - s.setup.spoil;
    // Straight up the CL surface is the top of the box, 20 x 10 squares, and the block is begun at its upper corners.
    const OrientationPoses& up = all[0];
    EXPECT_EQ(up.regions.size(), 2U);
    EXPECT_EQ(count(up, PoseKind::corner), 4U);
    EXPECT_GE(count(up, PoseKind::tip), 200U);
    EXPECT_LE(count(up, PoseKind::tip), 260U);
    for (const PoseRegion& region : up.regions) {
        for (const MillingPose& pose : region.poses) {
            if (pose.kind == PoseKind::tip) {
                // On the box, or beside it.
                EXPECT_NEAR(std::abs(pose.tip.z - 60), 60, 1e-3);
            }
            if (pose.kind == PoseKind::corner || pose.kind == PoseKind::edge) {
                EXPECT_NEAR(pose.tip.z, top, 1e-9);
            }
            if (pose.kind == PoseKind::retract) {
                EXPECT_NEAR(pose.tip.z, top + cell.clearance, 1e-3);
            }
        }
    }
    // A tilted tool comes to one more side of the block, down to the base: the spoil layer below it is left standing.
    EXPECT_EQ(count(all[1], PoseKind::corner), 6U);
    double least = 1e9;
    for (const MillingPose& pose : all[1].regions.front().poses) least = std::min(least, pose.tip.z);
    EXPECT_NEAR(least, 0, 1e-9);
}

TEST(MillingPoses, StandNoFartherApartThanTheStep) {
    const Cell cell = ready_cell("irb6640-185-2.8.toml");
    BoxSetup s = box_setup(cell, {300, 300, 150}, {{0, 0, 1}, tool_axis(40, 70)});
    s.mesh = shapes::moved(shapes::ball({0, 0, 0}, 75), {0, 0, 75});
    for (const OrientationPoses& orientation : milling_poses(s.setup, s.mesh, cell)) {
        for (const PoseRegion& region : orientation.regions) {
            ASSERT_FALSE(region.poses.empty());
            EXPECT_LE(region.extremes, region.poses.size());
            EXPECT_EQ(region.poses.front().beside, 0U);
            for (std::size_t i = 1; i < region.poses.size(); ++i) {
                ASSERT_LT(region.poses[i].beside, i);
                const Vec3 apart = region.poses[i].tip - region.poses[region.poses[i].beside].tip;
                if (region.poses[i].kind != PoseKind::tip || i < region.extremes) continue;
                // Across the tool; two squares of 20 mm.
                EXPECT_LE(norm(apart - dot(apart, orientation.tool_axis) * orientation.tool_axis),
                          20 * std::sqrt(5.0) + 1e-6);
            }
        }
    }
}

// Seen straight from above a ball leaves the corners of its rectangle free, and there the tool goes down to the base
// unless holder or spindle would touch the ball.
double lowest_beside_a_ball(const Cell& cell, double radius) {
    BoxSetup s = box_setup(cell, {2 * radius, 2 * radius, 2 * radius}, {{0, 0, 1}});
    s.mesh = shapes::moved(shapes::ball({0, 0, 0}, radius, 40), {0, 0, radius});
    const std::vector<OrientationPoses> all = milling_poses(s.setup, s.mesh, cell);
    double least = 1e9;
    for (const PoseRegion& region : all.front().regions) {
        for (const MillingPose& pose : region.poses) least = std::min(least, pose.tip.z);
    }
    return least;
}

TEST(MillingPoses, GoDownBesideThePieceWhereTheHolderAllowsIt) {
    const Cell cell = ready_cell("kr60-ha.toml");  // the spindle begins 200 above the tip, and is 180 wide
    EXPECT_NEAR(lowest_beside_a_ball(cell, 80), 0, 1e-3);
    // 62 beside the equator, where the spindle stands on the ball: at the height h where the ball is 122 wide.
    const double height = 150 + std::sqrt(150.0 * 150 - 122.0 * 122) - 200;
    EXPECT_NEAR(lowest_beside_a_ball(cell, 150), height, 12);  // on cells of 5 mm
}

TEST(MillingPoses, ThatAreExtremeBoundTheOthers) {
    const Cell cell = ready_cell("kr60-ha.toml");
    BoxSetup s = box_setup(cell, {300, 300, 150}, {{0, 0, 1}, tool_axis(35, 200)});
    s.mesh = shapes::moved(shapes::torus({0, 0, 0}, 100, 40), {0, 0, 40});
    for (const OrientationPoses& orientation : milling_poses(s.setup, s.mesh, cell)) {
        for (const PoseRegion& region : orientation.regions) {
            for (int axis = 0; axis < 3; ++axis) {
                double least = 1e9;
                double most = -1e9;
                for (std::size_t i = 0; i < region.extremes; ++i) {
                    if (region.poses[i].kind == PoseKind::retract) continue;
                    least = std::min(least, region.poses[i].tip[axis]);
                    most = std::max(most, region.poses[i].tip[axis]);
                }
                for (const MillingPose& pose : region.poses) {
                    if (pose.kind != PoseKind::tip) continue;
                    EXPECT_GE(pose.tip[axis], least - 1e-9);
                    EXPECT_LE(pose.tip[axis], most + 1e-9);
                }
            }
        }
    }
    PoseOptions options;
    options.extremes_only = true;
    for (const OrientationPoses& orientation : milling_poses(s.setup, s.mesh, cell, options)) {
        for (const PoseRegion& region : orientation.regions) EXPECT_EQ(region.poses.size(), region.extremes);
    }
}

TEST(MillingPoses, OfPartsThatDoNotTouchAreRegionsOfTheirOwn) {
    const Cell cell = ready_cell("kr60-ha.toml");
    BoxSetup s = box_setup(cell, {500, 100, 50}, {tool_axis(30, 90)});
    s.mesh = shapes::joined({shapes::box({-250, -50, 0}, {-100, 50, 50}), shapes::box({100, -50, 0}, {250, 50, 50})});
    EXPECT_EQ(milling_poses(s.setup, s.mesh, cell).front().regions.size(), 3U);
}

}  // namespace
}  // namespace qchopper
