// The values of the work envelope: the block's place, the tables of checks, and what people read.

#include "cam/setup/placement/machine_reachability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>

#include "cam/setup/reachable_directions.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

TEST(BlockPlacement, IsOverTheMiddleOfTheTableByDefault) {
    for (const char* const name : {"kr60-ha.toml", "kr120-r2500-pro-rotary.toml", "gantry-3axis.toml", "foam-1.toml"}) {
        const Cell cell = ready_cell(name);
        EXPECT_EQ(setup_in_cell(cell, 12, {}, 0), setup_in_cell(cell, 12)) << name;
    }
}

TEST(BlockPlacement, ShiftsAlongTheTableAndTurnsTheBlockAboutItsMiddle) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const Pose pose = setup_in_cell(cell, 12, {100, -50, pi / 2, {}}, 0);
    EXPECT_LT(norm(pose.shift - Vec3{1300, -50, 312}), 1e-9);
    EXPECT_LT(norm(rotate(pose, {1, 0, 0}) - Vec3{0, 1, 0}), 1e-12);
    const Cell rotary = ready_cell("kr120-r2500-pro-rotary.toml");
    const BlockPlacement turned{100, 0, 0, {0, pi / 2}};
    EXPECT_LT(norm(setup_in_cell(rotary, 10, turned, 0).shift - Vec3{1550, 0, 310}), 1e-9);
    EXPECT_LT(norm(setup_in_cell(rotary, 10, turned, 1).shift - Vec3{1450, 100, 310}), 1e-9);
}

TEST(BlockPlacement, TellsHowFarTheBlockStaysInside) {
    const Cell cell = ready_cell("kr60-ha.toml");  // 700 x 1000
    EXPECT_NEAR(inside_table(cell, {500, 600, 100}, {}), 100, 1e-9);
    EXPECT_NEAR(inside_table(cell, {500, 600, 100}, {0, 0, pi / 2, {}}), 50, 1e-9);
    EXPECT_NEAR(inside_table(cell, {500, 600, 100}, {150, 0, 0, {}}), -50, 1e-9);
    const Cell rotary = ready_cell("kr120-r2500-pro-rotary.toml");  // radius 750
    EXPECT_NEAR(inside_table(rotary, {600, 800, 100}, {0, 0, 1.2, {}}), 250, 1e-9);
}

TEST(MachineReachability, NamesEveryCheckOnce) {
    std::set<std::string> keys;
    for (std::size_t c = 0; c < pose_checks; ++c) {
        const CheckRule& rule = rule_of(static_cast<PoseCheck>(c));
        EXPECT_EQ(static_cast<std::size_t>(rule.check), c);
        EXPECT_GT(rule.scale, 0);
        keys.insert(rule.key);
    }
    EXPECT_EQ(keys.size(), pose_checks);
}

TEST(MachineReachability, TheFrameOfTheTipPointsAgainstTheWayOut) {
    for (const Vec3 tool_axis : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0, -0.8, 0.6}, Vec3{0.48, 0.6, 0.64}}) {
        for (const double turn : {0.0, 1.0, -2.5}) {
            const Pose frame = tip_frame({1, 2, 3}, tool_axis, turn);
            EXPECT_LT(norm(rotate(frame, {0, 0, 1}) + tool_axis), 1e-12);
            EXPECT_LT(norm(apply(frame * inverse(frame), {4, 5, 6}) - Vec3{4, 5, 6}), 1e-12);
            EXPECT_GT(dot(cross(rotate(frame, {1, 0, 0}), rotate(frame, {0, 1, 0})), -tool_axis), 0.999);
            EXPECT_EQ(apply(frame, {0, 0, 0}), (Vec3{1, 2, 3}));
        }
    }
    EXPECT_LT(norm(rotate(tip_frame({}, {0, 0, 1}, 0), {1, 0, 0}) - Vec3{-1, 0, 0}), 1e-12);
}

MachineReachability with(double joint_limit, double holder) {
    MachineReachability reachability;
    reachability.is_arm_checked = true;
    ReachabilityPose pose;
    pose.tip = {10, -20.04, 30};
    pose.orientation = 1;
    reachability.margins = {
        {PoseCheck::joint_limit, joint_limit, joint_limit / 10, "axis 5 and its upper limit", pose},
        {PoseCheck::holder_to_block, holder, holder / 50, "holder or spindle and the spoil layer", pose}};
    return reachability;
}

TEST(MachineReachability, HoldsIfNoMarginIsNegative) {
    EXPECT_TRUE(with(2, 0).holds());
    EXPECT_FALSE(with(-0.1, 5).holds());
    EXPECT_FALSE(with(2, -5).holds());
}

TEST(MachineReachability, IsTightestWhereSomethingCanBeDoneAboutIt) {
    EXPECT_EQ(with(2, 0).tightest().check, PoseCheck::joint_limit);  // no place of the block changes the other
    EXPECT_EQ(with(2, -5).tightest().check, PoseCheck::holder_to_block);
    EXPECT_EQ(with(-20, -5).tightest().check, PoseCheck::joint_limit);
}

TEST(MachineReachability, IsDescribedWithPosePairMarginAndRemedy) {
    EXPECT_EQ(describe_reachability("B", with(2, 3)),
              "piece B can be carved, tightest: joint limit, axis 5 and its upper limit: 2 deg "
              "(tip on the piece at 10, -20, 30 mm, orientation 2)");
    MachineReachability refused = with(-4.25, 3);
    refused.remedy = Remedy::base;
    EXPECT_EQ(describe_reachability("B", refused),
              "piece B cannot be carved: joint limit, axis 5 and its upper limit: -4.3 deg "
              "(tip on the piece at 10, -20, 30 mm, orientation 2); to do: lay the piece on another base");
    EXPECT_EQ(describe_reachability("B", {}), "piece B: arm not checked");
}

}  // namespace
}  // namespace qchopper
