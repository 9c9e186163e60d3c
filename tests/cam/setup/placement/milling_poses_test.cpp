// The poses of a setup: on the piece, at the block, above them, and how they hang together.

#include "cam/setup/placement/milling_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/cam/cell/short_tools.h"
#include "tests/cam/setup/random_setups.h"

namespace qchopper {
namespace {

using test_setups::box_setup;
using test_setups::BoxSetup;
using test_setups::tool_axis;

Cell ready_cell(const std::string& name) {
    return with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name));
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
    const BoxSetup s = box_setup(cell, {400, 200, 120}, {{0, 0, 1}});
    const std::vector<OrientationPoses> all = milling_poses(s.setup, s.mesh, cell);
    ASSERT_EQ(all.size(), 1U);
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
}

TEST(MillingPoses, NoneStandsOnACapThatIsSawn) {
    const Cell cell = ready_cell("kr60-ha.toml");
    BoxSetup s = box_setup(cell, {400, 200, 120}, {{0, 0, 1}});
    const auto on_top = [&] {
        std::size_t found = 0;
        for (const OrientationPoses& orientation : milling_poses(s.setup, s.mesh, cell)) {
            for (const PoseRegion& region : orientation.regions) {
                for (const MillingPose& pose : region.poses) {
                    const bool is_over_it = std::abs(pose.tip.x) < 190 && std::abs(pose.tip.y) < 90;
                    if (pose.kind == PoseKind::tip && is_over_it && std::abs(pose.tip.z - 120) < 1) ++found;
                }
            }
        }
        return found;
    };
    EXPECT_GT(on_top(), 100U);
    s.setup.flush_caps = {{1, BlockFace::top, 400.0 * 200}};
    s.setup.block.size.z = 120 + s.setup.spoil;
    EXPECT_EQ(on_top(), 0U);
}

TEST(MillingPoses, OfATiltedToolThatIsTheFirstComeToOneMoreSideOfTheBlock) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const BoxSetup s = box_setup(cell, {400, 200, 120}, {tool_axis(30, 0)});
    const OrientationPoses tilted = milling_poses(s.setup, s.mesh, cell).front();
    // Down to the base: the spoil layer below it is left standing.
    EXPECT_EQ(count(tilted, PoseKind::corner), 6U);
    double least = 1e9;
    for (const MillingPose& pose : tilted.regions.front().poses) least = std::min(least, pose.tip.z);
    EXPECT_NEAR(least, 0, 1e-9);
}

// A table of 500 x 200 on a leg of 40 x 40: what stands under its top, and no more, is left to a tilted tool.
BoxSetup table_setup(const Cell& cell, const std::vector<Vec3>& directions) {
    BoxSetup s = box_setup(cell, {800, 200, 120}, directions);
    s.mesh = shapes::joined(
        {shapes::box({-20, -20, 0}, {20, 20, 100}, 4), shapes::box({-400, -100, 100}, {100, 100, 120}, 4)});
    return s;
}

TEST(MillingPoses, OfAFurtherOrientationAreWhereTheOnesBeforeLeaveFoam) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const BoxSetup box = box_setup(cell, {400, 200, 120}, {{0, 0, 1}, tool_axis(30, 0)});
    EXPECT_TRUE(milling_poses(box.setup, box.mesh, cell)[1].regions.empty()) << "straight up mills all of a box";
    // From +x the tool comes to the foam on that side of the leg.
    const BoxSetup table = table_setup(cell, {{0, 0, 1}, tool_axis(50, 0), tool_axis(50, 0)});
    const std::vector<OrientationPoses> all = milling_poses(table.setup, table.mesh, cell);
    ASSERT_FALSE(all[1].regions.empty());
    Box tips{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
    for (const PoseRegion& region : all[1].regions) {
        for (const MillingPose& pose : region.poses) {
            if (pose.kind == PoseKind::tip) extend(tips, pose.tip);
        }
    }
    EXPECT_LE(tips.min.z, 5) << "down to the base, on cells of 2.5";
    EXPECT_LE(tips.max.z, 121);
    // Its top is finished from above, but for what lies four steps beside the foam under its edge.
    const double inner = 100 - 4 * 20 / std::cos(50 * std::numbers::pi / 180);
    for (const PoseRegion& region : all[1].regions) {
        for (const MillingPose& pose : region.poses) {
            const bool is_on_top = pose.kind == PoseKind::tip && pose.tip.z > 119;
            EXPECT_TRUE(!is_on_top || pose.tip.x >= inner - 10) << pose.tip.x;
        }
    }
    EXPECT_TRUE(all[2].regions.empty()) << "the same orientation again has nothing to do";
}

TEST(MillingPoses, StandNoFartherApartThanTheStep) {
    const Cell cell = ready_cell("irb6640-185-2.8.toml");
    BoxSetup s = box_setup(cell, {300, 300, 150}, {{0, 0, 1}, tool_axis(40, 70)});
    s.mesh = shapes::moved(shapes::ball({0, 0, 0}, 75), {0, 0, 75});
    ASSERT_FALSE(milling_poses(s.setup, s.mesh, cell)[1].regions.empty()) << "below the equator";
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
