// Bodies of the machine: against forward() and the shape of the arms, and what may touch.

#include "cam/cell/machine_bodies.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "cam/cell/reach_map.h"

namespace qchopper {
namespace {

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

Joints random_joints(const JointRanges& ranges, std::mt19937& random) {
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] = std::uniform_real_distribution<double>(ranges[axis].min, ranges[axis].max)(random);
    }
    return joints;
}

TEST(MachineBodies, MoveAsTheArmDoes) {
    std::mt19937 random(5);
    for (const char* const name : {"kr60-ha.toml", "irb6640-185-2.8.toml", "kr120-r2500-pro-rotary.toml"}) {
        const Cell cell = ready_cell(name);
        const Robot& robot = *cell.machine->robot;
        const CuttingTool& tool = cell.machine->tools.front();
        const ToolArm arm = tool_arm(robot, cell.machine->spindle, tool);
        for (int i = 0; i < 100; ++i) {
            const Joints joints = random_joints(robot.ranges, random);
            const Pose flange = robot.base_in_cell * forward(robot.geometry, joints);
            const Vec3 z{flange.row[0].z, flange.row[1].z, flange.row[2].z};
            const MovingBodies bodies = bodies_at(cell, tool, joints);
            // In these cells the forearm's capsule ends in the wrist centre, and the wrist's in the flange.
            const Vec3 wrist = flange.shift - robot.geometry.c4 * z;
            EXPECT_LT(norm(bodies.links[1].shape.to - wrist), 1e-9);
            EXPECT_LT(norm(bodies.links[2].shape.from - wrist), 1e-9);
            EXPECT_NEAR(norm(bodies.links[0].shape.to - bodies.links[0].shape.from), robot.geometry.c2, 1e-9);
            const Pose tip = flange * arm.tip_in_flange;
            EXPECT_LT(norm(bodies.on_axis.front().shape.from - tip.shift), 1e-9);
            EXPECT_EQ(bodies.on_axis.back().part, BodyPart::spindle);
            EXPECT_LT(norm(bodies.on_axis.back().shape.to - flange.shift), 1e-9);  // its body ends at the flange
        }
    }
}

TEST(MachineBodies, OfEveryLinkTurnWithItsAxisAlone) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const Robot& robot = *cell.machine->robot;
    const Joints home = cell.machine->start.joints;
    const LinkMotions before = link_motions(robot.geometry, home);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        Joints joints = home;
        joints[axis] += 0.2;
        const LinkMotions after = link_motions(robot.geometry, joints);
        for (std::size_t link = 0; link <= axes_of_arm; ++link) EXPECT_EQ(before[link] == after[link], link <= axis);
    }
}

TEST(MachineBodies, StandWhereTheCellFileSays) {
    const StandingBodies fixed = standing_bodies(ready_cell("kr60-ha.toml"));
    ASSERT_TRUE(fixed.table && !fixed.rotary);
    EXPECT_EQ(fixed.table->half, (Vec3{350, 500, 150}));
    EXPECT_EQ(fixed.table->box_in_frame.shift, (Vec3{1200, 0, 150}));
    const StandingBodies rotary = standing_bodies(ready_cell("kr120-r2500-pro-rotary.toml"));
    ASSERT_TRUE(!rotary.table && rotary.rotary);
    EXPECT_EQ(rotary.rotary->radius, 750);
    EXPECT_EQ(rotary.rotary->from.z, 300);
    EXPECT_EQ(rotary.rotary->to.z, 0);
    EXPECT_EQ(rotary.obstacles.size(), 1U);
    EXPECT_EQ(standing_bodies(ready_cell("gantry-3axis.toml")).floor_z, 0);
}

TEST(MachineBodies, OfAGantryHangAboveItsTip) {
    const Cell cell = ready_cell("gantry-3axis.toml");
    const MovingBodies bodies = bodies_at(cell, cell.machine->tools.front(), {}, {100, 200, 300});
    EXPECT_TRUE(bodies.links.empty());
    EXPECT_EQ(bodies.on_axis.front().shape.from, (Vec3{100, 200, 300}));
    EXPECT_EQ(bodies.on_axis.back().shape.to.z, 300 + 200 + 350);
}

// Against the capsule of the link as the arm has it.
TEST(MachineBodies, TheWristIsOverTheTipWhateverTheJoints) {
    std::mt19937 random(6);
    for (const char* const name : {"kr60-ha.toml", "irb6640-185-2.8.toml", "kr120-r2500-pro-rotary.toml"}) {
        const Cell cell = ready_cell(name);
        const CellMachine& machine = *cell.machine;
        const CuttingTool& tool = machine.tools.front();
        ASSERT_TRUE(is_about_tool_axis(machine.robot->capsules[2], *machine.robot, machine.spindle)) << name;
        EXPECT_FALSE(is_about_tool_axis(machine.robot->capsules[1], *machine.robot, machine.spindle));
        const std::vector<AxisBody> over_tip = bodies_over_tip(tool, machine);
        const AxisBody& wrist = over_tip.back();
        ASSERT_EQ(wrist.part, BodyPart::link);
        EXPECT_EQ(wrist.shape.radius, machine.robot->capsules[2].shape.radius);
        for (int i = 0; i < 50; ++i) {
            const MovingBodies bodies = bodies_at(cell, tool, random_joints(machine.robot->ranges, random));
            const AxisBody& spindle = bodies.on_axis.back();
            const Vec3 tip = bodies.on_axis.front().shape.from;
            const Vec3 up = normalized(spindle.shape.to - spindle.shape.from);
            const Capsule& link = bodies.links[2].shape;
            // Every point of the capsule's surface is in the spindle or in the wrist.
            for (int k = 0; k < 200; ++k) {
                std::normal_distribution<double> normal;
                const Vec3 out = normalized(Vec3{normal(random), normal(random), normal(random)});
                const Vec3 p = (k % 2 == 0 ? link.from : link.to) + link.radius * out;
                const double above = dot(p - tip, up);
                const double beside = norm(p - tip - above * up);
                const bool is_in_wrist = above >= -wrist.shape.from.z - 1e-6 && above <= -wrist.shape.to.z + 1e-6;
                EXPECT_TRUE(is_in_wrist || beside <= spindle.shape.radius + 1e-6) << name << " " << above;
                EXPECT_LE(beside, wrist.shape.radius + 1e-6);
            }
        }
    }
}

TEST(MachineBodies, AWristBesideTheToolAxisIsNotOverTheTip) {
    Cell cell = ready_cell("kr60-ha.toml");
    cell.machine->spindle.spindle_in_flange.shift.x = 1;
    EXPECT_EQ(bodies_over_tip(cell.machine->tools.front(), *cell.machine).back().part, BodyPart::spindle);
}

TEST(MachineBodies, NeighboursMayTouchBothWays) {
    for (int a = 0; a < 8; ++a) {
        EXPECT_TRUE(may_touch(a, a));
        for (int b = 0; b < 8; ++b) EXPECT_EQ(may_touch(a, b), may_touch(b, a));
        if (a < 6) {
            EXPECT_TRUE(may_touch(a, a + 1));
        }
    }
    EXPECT_FALSE(may_touch(2, 5));
    EXPECT_FALSE(may_touch(3, 7));
}

}  // namespace
}  // namespace qchopper
