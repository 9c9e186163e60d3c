// The work envelope of setups: what refuses them, what remedies them, and where the block goes.

#include "cam/setup/placement/place_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "cam/cell/reach_map.h"
#include "cam/setup/holder_clearance.h"
#include "cam/setup/placement/place_score.h"
#include "tests/cam/cell/short_tools.h"
#include "tests/cam/setup/random_setups.h"
#include "tests/reference/cam/setup/holds_at_placement.h"

namespace qchopper {
namespace {

using test_setups::box_setup;
using test_setups::BoxSetup;
using test_setups::tool_axis;

constexpr double degree = std::numbers::pi / 180;
constexpr Vec3 up{0, 0, 1};

Cell ready_cell(const std::string& name) {
    return with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name));
}

Cell kr60() {
    return ready_cell("kr60-ha.toml");
}

std::vector<Cell> ready_cells() {
    return {kr60(), ready_cell("irb6640-185-2.8.toml"), ready_cell("kr120-r2500-pro-rotary.toml"),
            ready_cell("gantry-3axis.toml")};
}

MachineReachability at_placement(const BoxSetup& s, const Cell& cell) {
    PlacementOptions options;
    options.is_searched = false;
    return place_block(s.setup, s.mesh, cell, options);
}

MachineReachability at_placement(const Setup& setup, const std::vector<OrientationPoses>& poses, const Cell& cell) {
    PlacementOptions options;
    options.is_searched = false;
    return place_block(setup, poses, cell, options);
}

std::vector<std::string> refusing(const MachineReachability& reachability) {
    std::vector<std::string> keys;
    for (const ReachabilityMargin& margin : reachability.margins) {
        if (margin.relative < -1e-9) keys.emplace_back(rule_of(margin.check).key);
    }
    return keys;
}

using Keys = std::vector<std::string>;

// Poses of the tip in the cell, with the tool pointing one way, as the poses of a setup at its placement.
std::vector<OrientationPoses> poses_in_cell(const Setup& setup, const Cell& cell, Vec3 way_out,
                                            const std::vector<Vec3>& tips) {
    const Pose cell_in_setup = inverse(setup_in_cell(cell, setup.spoil, setup.placement, 0));
    PoseRegion region;
    for (const Vec3& tip : tips) {
        const std::size_t before = region.poses.empty() ? 0 : region.poses.size() - 1;
        region.poses.push_back({PoseKind::tip, apply(cell_in_setup, tip), before});
    }
    region.extremes = region.poses.size();
    return {{rotate(cell_in_setup, way_out), {region}}};
}

BoxSetup small_box(const Cell& cell) {
    return box_setup(cell, {150, 150, 80}, {up});
}

TEST(PlaceBlock, HoldsASmallBoxInEveryReadyCell) {
    for (const Cell& cell : ready_cells()) {
        const BoxSetup s = small_box(cell);
        const MachineReachability reachability = place_block(s.setup, s.mesh, cell);
        EXPECT_TRUE(reachability.is_arm_checked);
        EXPECT_TRUE(reachability.holds()) << cell.name << ": " << describe_reachability("A", reachability);
        EXPECT_TRUE(fits_machine(s.setup, s.mesh, cell)) << cell.name;
        EXPECT_GE(inside_table(cell, s.setup.block.size, reachability.placement), 0);
        EXPECT_GT(reachability.poses, 50U);
    }
}

// A program begins with the table at 0, and turns it while the arm is at home: there the tool hangs lower than this
// block is high.
TEST(PlaceBlock, RefusesABlockThatComesToTheToolAtHomeWhileTheTableTurns) {
    const Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    BoxSetup s = box_setup(cell, {538, 203, 733}, {up});
    const auto refused_at = [&](double y, double angle) {
        s.setup.placement = {0, y, 0, {angle * degree}};
        const std::vector<OrientationPoses> poses = poses_in_cell(s.setup, cell, up, {{1450, 0, 1150}});
        const MachineReachability reachability = at_placement(s.setup, poses, cell);
        EXPECT_EQ(reachability.holds(), holds_at_placement(s.setup, poses, cell)) << y << " " << angle;
        return refusing(reachability);
    };
    EXPECT_EQ(refused_at(300, 120), Keys{});
    EXPECT_EQ(refused_at(-100, 30), Keys{"tool_to_block"}) << "at 0";
    EXPECT_EQ(refused_at(180, 170), Keys{"tool_to_block"}) << "on the way";
    EXPECT_EQ(refused_at(180, -120), Keys{});
}

TEST(PlaceBlock, ChecksNoArmInACellOfVersion1) {
    const Cell cell = ready_cell("foam-1.toml");
    BoxSetup s;
    s.mesh = shapes::box({0, 0, 0}, {10, 10, 10});
    const MachineReachability reachability = place_block(s.setup, s.mesh, cell);
    EXPECT_FALSE(reachability.is_arm_checked);
    EXPECT_EQ(describe_reachability("A", reachability), "piece A: arm not checked");
    EXPECT_TRUE(fits_machine(s.setup, s.mesh, cell));
}

TEST(PlaceBlock, RefusesAPoseBeyondAJointLimit) {
    Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    ASSERT_TRUE(at_placement(s, cell).holds());
    cell.machine->robot->ranges[0] = {1 * degree, 90 * degree, cell.machine->robot->ranges[0].speed, 1};
    EXPECT_EQ(refusing(at_placement(s, cell)), Keys{"joint_limit"});
}

TEST(PlaceBlock, RefusesWhatTheCablesDoNotAllow) {
    Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    cell.machine->robot->cable->axis_6 = {-5 * degree, 5 * degree};
    const MachineReachability reachability = at_placement(s, cell);
    EXPECT_EQ(refusing(reachability), Keys{"cable"});
    EXPECT_EQ(reachability.tightest().pair.substr(0, 6), "axis 6");
}

TEST(PlaceBlock, RefusesASpeedThatAJointDoesNotHave) {
    Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    for (CuttingTool& tool : cell.machine->tools) tool.feed_max_mm_per_s = 1300;
    const MachineReachability reachability = at_placement(s, cell);
    EXPECT_EQ(refusing(reachability), Keys{"joint_speed"}) << describe_reachability("A", reachability);
}

TEST(PlaceBlock, RefusesAConfigurationThatChangesInTheMiddleOfARegion) {
    Cell cell = kr60();
    Robot& robot = *cell.machine->robot;
    robot.ranges[0].min = -60 * degree;
    robot.ranges[0].max = 60 * degree;
    robot.ranges[3].min = -93 * degree;  // 90 with what is kept from the end
    robot.ranges[3].max = 93 * degree;
    const BoxSetup s = small_box(cell);
    // The tool lies level along y, so that axis 4 passes 90 degrees where the arm does.
    const auto tips = [](double from, double to) {
        std::vector<Vec3> all;
        for (double y = from; y <= to; y += 20) all.push_back({1250, 700 + y, 900});
        return all;
    };
    const Vec3 way_out{0, -1, 0};
    const auto whole = at_placement(s.setup, poses_in_cell(s.setup, cell, way_out, tips(-200, 200)), cell);
    EXPECT_FALSE(whole.holds());
    const Keys keys = refusing(whole);
    EXPECT_NE(std::find(keys.begin(), keys.end(), "one_configuration"), keys.end())
        << describe_reachability("A", whole);
    // Both halves are held, each by a configuration of its own.
    bool flipped[2] = {false, false};
    int half = 0;
    double middle = 1e9;
    for (double y = -200; y < 200 && middle > 1e8; y += 20) {
        const auto lower = at_placement(s.setup, poses_in_cell(s.setup, cell, way_out, tips(-200, y)), cell);
        const auto higher = at_placement(s.setup, poses_in_cell(s.setup, cell, way_out, tips(y + 20, 200)), cell);
        if (!lower.holds() || !higher.holds()) continue;
        middle = y;
        flipped[half++] = lower.regions.front().configuration.is_wrist_flipped;
        flipped[half] = higher.regions.front().configuration.is_wrist_flipped;
    }
    ASSERT_LT(middle, 1e8);
    EXPECT_NE(flipped[0], flipped[1]);
}

TEST(PlaceBlock, RefusesAWristSingularityOnThePath) {
    Cell cell = kr60();
    Robot& robot = *cell.machine->robot;
    robot.ranges[0].min = -60 * degree;  // so that the arm does not bend backwards instead
    robot.ranges[0].max = 60 * degree;
    robot.ranges[2].min = 60 * degree;  // nor the elbow
    const CuttingTool& tool = longest_tool(cell.machine->tools);
    const ToolArm arm = tool_arm(robot, cell.machine->spindle, tool);
    const BoxSetup s = small_box(cell);
    const Pose tip =
        robot.base_in_cell * (forward(robot.geometry, {0, -90 * degree, 110 * degree, 0, 0, 0}) * arm.tip_in_flange);
    const Vec3 way_out = -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z};
    // 5 degrees beside the singular pose, where no joint is too slow yet.
    const Vec3 beside{tip.row[0].x, tip.row[1].x, tip.row[2].x};
    std::vector<Vec3> path;
    for (double y = -300; y <= 300; y += 20) path.push_back(tip.shift + 60 * beside + Vec3{0, y, 0});
    const auto refused = at_placement(s.setup, poses_in_cell(s.setup, cell, way_out, path), cell);
    EXPECT_EQ(refusing(refused), Keys{"wrist"}) << describe_reachability("A", refused);
    EXPECT_EQ(refused.tightest().pair, "axes 4 and 6 in line");
    // Its ends are held.
    const std::vector<Vec3> end(path.end() - 5, path.end());
    const auto held = at_placement(s.setup, poses_in_cell(s.setup, cell, way_out, end), cell);
    EXPECT_TRUE(held.holds()) << describe_reachability("A", held);
}

TEST(PlaceBlock, RefusesAHolderInTheBlock) {
    const Cell cell = kr60();
    BoxSetup s = small_box(cell);
    s.setup.spoil = 150;  // so that the table is farther off
    s.setup.block.size.z += 140;
    const Pose in_cell = setup_in_cell(cell, s.setup.spoil, {}, 0);
    const auto tilted = [&](double tip_z) {
        return poses_in_cell(s.setup, cell, tool_axis(75, 180), {apply(in_cell, {-60, 0, tip_z})});
    };
    EXPECT_TRUE(at_placement(s.setup, tilted(60), cell).holds())
        << describe_reachability("A", at_placement(s.setup, tilted(60), cell));
    EXPECT_EQ(refusing(at_placement(s.setup, tilted(20), cell)), Keys{"holder_to_block"});
}

TEST(PlaceBlock, RefusesAnArmInAnObstacle) {
    Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    const MachineReachability before = at_placement(s, cell);
    cell.machine->obstacles.push_back({"beam", {{-300, -1500, 1650}, {1600, 1500, 1700}}});
    const MachineReachability after = at_placement(s, cell);
    EXPECT_TRUE(before.holds());
    const Keys keys = refusing(after);
    EXPECT_NE(std::find(keys.begin(), keys.end(), "arm_to_obstacle"), keys.end());
    EXPECT_NE(after.tightest().pair.find("the obstacle beam"), std::string::npos) << describe_reachability("A", after);
}

TEST(PlaceBlock, RefusesASpindleInAnObstacle) {
    Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    // Beside the spindle, below the arm.
    cell.machine->obstacles.push_back({"clamp", {{1270, -60, 640}, {1300, 60, 660}}});
    const MachineReachability after = at_placement(s, cell);
    EXPECT_EQ(refusing(after), Keys{"tool_to_obstacle"}) << describe_reachability("A", after);
}

TEST(PlaceBlock, RefusesAnArmInTheBlock) {
    const Cell cell = ready_cell("irb6640-185-2.8.toml");
    const BoxSetup s = box_setup(cell, {300, 300, 700}, {up});
    const Pose in_cell = setup_in_cell(cell, s.setup.spoil, {}, 0);
    const auto deep = poses_in_cell(s.setup, cell, up, {apply(in_cell, {0, 0, 5})});
    const MachineReachability reachability = at_placement(s.setup, deep, cell);
    EXPECT_EQ(refusing(reachability), Keys{"arm_to_block"}) << describe_reachability("A", reachability);
    EXPECT_EQ(reachability.remedy, Remedy::base);
    const auto high = poses_in_cell(s.setup, cell, up, {apply(in_cell, {0, 0, 500})});
    EXPECT_TRUE(at_placement(s.setup, high, cell).holds());
}

TEST(PlaceBlock, RefusesWhatIsOutOfReach) {
    const Cell cell = kr60();
    const BoxSetup s = small_box(cell);
    const auto reachability = at_placement(s.setup, poses_in_cell(s.setup, cell, up, {{2600, 0, 500}}), cell);
    EXPECT_EQ(refusing(reachability), Keys{"reach"});
    EXPECT_LT(reachability.tightest().margin, -100);
}

TEST(PlaceBlock, RefusesABlockThatIsLargerThanTheTable) {
    const Cell cell = kr60();
    const BoxSetup s = box_setup(cell, {720, 300, 80}, {up});
    const MachineReachability reachability = place_block(s.setup, s.mesh, cell);
    const MachineReachability turned = place_block(box_setup(cell, {1100, 300, 80}, {up}).setup, s.mesh, cell);
    EXPECT_TRUE(reachability.holds()) << describe_reachability("A", reachability);  // it is turned
    EXPECT_GE(static_cast<int>(reachability.remedy), static_cast<int>(Remedy::block_shift));
    EXPECT_FALSE(turned.holds());
    EXPECT_EQ(refusing(turned).front(), "block_on_table");
}

TEST(PlaceBlock, RefusesTheTravelOfAGantry) {
    Cell cell = ready_cell("gantry-3axis.toml");
    const BoxSetup s = box_setup(cell, {500, 500, 890}, {up});
    EXPECT_EQ(refusing(place_block(s.setup, s.mesh, cell)), Keys{"travel"});
    BoxSetup tilted = box_setup(cell, {100, 100, 100}, {up, tool_axis(20, 0)});
    test_setups::undercut(tilted);
    EXPECT_EQ(refusing(place_block(tilted.setup, tilted.mesh, cell)), Keys{"travel"});
}

TEST(PlaceBlock, ShiftsTheBlockAwayFromAnObstacle) {
    Cell cell = ready_cell("gantry-3axis.toml");
    const BoxSetup s = small_box(cell);
    cell.machine->obstacles.push_back({"post", {{1450, 950, 0}, {1550, 1050, 900}}});
    const MachineReachability reachability = place_block(s.setup, s.mesh, cell);
    EXPECT_TRUE(reachability.holds());
    EXPECT_EQ(reachability.remedy, Remedy::block_shift);
    EXPECT_GT(std::hypot(reachability.placement.x, reachability.placement.y), 100);
}

TEST(PlaceBlock, TurnsARotaryTableForADirection) {
    const Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    const BoxSetup s = box_setup(cell, {300, 300, 200}, {up, tool_axis(45, 0), tool_axis(45, 180)});
    const MachineReachability reachability = place_block(s.setup, s.mesh, cell);
    EXPECT_TRUE(reachability.holds()) << describe_reachability("A", reachability);
    ASSERT_EQ(reachability.placement.table_angles.size(), 3U);
    const double between = std::abs(
        std::remainder(reachability.placement.table_angles[1] - reachability.placement.table_angles[2], 360 * degree));
    EXPECT_GT(between, 90 * degree);  // opposite directions are turned to the same side of the robot
}

// The best score of a region over all configurations and turns about the tool axis so many degrees apart.
double best_by_trying(const Cell& cell, const BoxSetup& s, const OrientationPoses& orientation,
                      const PoseRegion& region, double step_deg) {
    PoseJudge judge(cell, longest_tool(cell.machine->tools));
    const StandingBlock block =
        judge.standing(setup_in_cell(cell, s.setup.spoil, s.setup.placement, 0), s.setup.block_box());
    double best = -1e9;
    for (const ArmConfiguration& configuration : all_configurations()) {
        for (double turn = 0; turn < 360; turn += step_deg) {
            MarginTally tally;
            ArmPosture posture{configuration, turn * degree, false};
            judge.judge(block, orientation.tool_axis, region, region.poses.size(), posture, -1e9, tally);
            best = std::max(best, tally.score());
        }
    }
    return best;
}

TEST(PlaceBlock, TurnsTheToolAboutItsAxisAsWellAsCanBe) {
    for (const bool is_across : {false, true}) {
        Cell cell = kr60();
        // With a spindle across the flange the turn moves all joints, else axis 6 alone.
        if (is_across) {
            cell.machine->spindle.spindle_in_flange = {{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}, {250, 0, 90}};
        }
        const BoxSetup s = box_setup(cell, {200, 250, 100}, {up});
        const std::vector<OrientationPoses> poses = milling_poses(s.setup, s.mesh, cell, {.step = 50});
        const MachineReachability reachability = at_placement(s.setup, poses, cell);
        ASSERT_EQ(reachability.regions.size(), poses[0].regions.size());
        for (std::size_t r = 0; r < reachability.regions.size(); ++r) {
            const PoseRegion& region = poses[0].regions[r];
            const double tried = best_by_trying(cell, s, poses[0], region, is_across ? 10 : 2);
            EXPECT_GE(reachability.regions[r].relative, tried - 1e-6);
            EXPECT_EQ(reachability.regions[r].holds, reachability.regions[r].relative >= 0);
        }
        EXPECT_TRUE(reachability.holds()) << describe_reachability("A", reachability);
    }
}

TEST(PlaceBlock, IsNeverWorseThanTheMiddleOfTheTable) {
    std::mt19937 random(23);
    int better = 0;
    for (const Cell& cell : ready_cells()) {
        for (int i = 0; i < 5; ++i) {
            const BoxSetup s = test_setups::random_setup(cell, random);
            const std::vector<OrientationPoses> poses = milling_poses(s.setup, s.mesh, cell, {.step = 50});
            const MachineReachability middle = at_placement(s.setup, poses, cell);
            const MachineReachability best = place_block(s.setup, poses, cell);
            EXPECT_TRUE(best.holds() || !middle.holds());
            if (!middle.holds()) continue;
            EXPECT_GE(best.tightest().relative, middle.tightest().relative - 1e-6) << cell.name;
            better += best.tightest().relative > middle.tightest().relative + 0.01 ? 1 : 0;
        }
    }
    EXPECT_GT(better, 3);
}

// The whole cell about the vertical by a quarter, the block with it.
Cell turned_by_a_quarter(Cell cell) {
    const Pose quarter{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}, {}};
    const auto box = [](const Box& b) { return Box{{-b.max.y, b.min.x, b.min.z}, {-b.min.y, b.max.x, b.max.z}}; };
    CellMachine& machine = *cell.machine;
    machine.robot->base_in_cell = quarter * machine.robot->base_in_cell;
    if (machine.rotary_table) machine.rotary_table->table_in_cell = quarter * machine.rotary_table->table_in_cell;
    for (Obstacle& obstacle : machine.obstacles) obstacle.box = box(obstacle.box);
    cell.workspace = box(cell.workspace);
    cell.table = {-cell.table.centre_y, cell.table.centre_x, cell.table.size_y, cell.table.size_x, cell.table.height};
    return cell;
}

TEST(PlaceBlock, IsTheSameWhenCellAndSetupAreTurned) {
    for (Cell cell : ready_cells()) {
        if (!cell.machine->robot) continue;
        cell.machine->obstacles.push_back({"post", {{1000, 700, 0}, {1100, 800, 1500}}});
        BoxSetup s = box_setup(cell, {200, 250, 150}, {up, tool_axis(25, 40)});
        s.setup.placement = {40, -30, 0.2, {}};
        if (cell.machine->rotary_table) s.setup.placement.table_angles = {0.5, 1.5};
        const MachineReachability before = at_placement(s, cell);
        if (!cell.machine->rotary_table) s.setup.placement = {30, 40, 0.2 + 90 * degree, {}};
        const MachineReachability after = at_placement(s, turned_by_a_quarter(cell));
        ASSERT_EQ(before.margins.size(), after.margins.size());
        for (std::size_t i = 0; i < before.margins.size(); ++i) {
            EXPECT_EQ(before.margins[i].check, after.margins[i].check);
            const double error = before.margins[i].check >= PoseCheck::arm_to_block ? 0.02 : 1e-5;
            EXPECT_NEAR(before.margins[i].margin, after.margins[i].margin, error) << before.margins[i].pair;
        }
    }
}

TEST(PlaceBlock, MoreLimitsNeverHoldMorePoses) {
    std::mt19937 random(3);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int held = 0;
    int lost = 0;
    for (int i = 0; i < 60; ++i) {
        Cell wide = kr60();
        const BoxSetup s = box_setup(wide, {number(100, 400), number(100, 600), number(50, 300)},
                                     {up, tool_axis(number(0, 40), number(0, 360))});
        PoseOptions coarse;
        coarse.extremes_only = true;
        const std::vector<OrientationPoses> poses = milling_poses(s.setup, s.mesh, wide, coarse);
        Cell narrow = wide;
        Robot& robot = *narrow.machine->robot;
        const auto axis = static_cast<std::size_t>(number(0, 6));
        robot.ranges[axis].min *= number(0.3, 1);
        robot.ranges[axis].max *= number(0.3, 1);
        robot.ranges[axis].speed *= number(0.2, 1);
        if (number(0, 1) < 0.3) {
            const Vec3 at{number(0, 2000), number(-1000, 1000), number(0, 1500)};
            narrow.machine->obstacles.push_back({"box", {at, at + Vec3{100, 100, 200}}});
        }
        const bool is_held = holds_at_placement(s.setup, poses, wide);
        const bool is_held_narrowly = holds_at_placement(s.setup, poses, narrow);
        EXPECT_TRUE(is_held || !is_held_narrowly);
        held += is_held ? 1 : 0;
        lost += is_held && !is_held_narrowly ? 1 : 0;
    }
    EXPECT_GT(held, 15);
    EXPECT_GT(lost, 3);
}

TEST(PlaceBlock, FindsAPlaceWhereAScanDoes) {
    std::mt19937 random(17);
    for (const Cell& cell : ready_cells()) {
        int found = 0;
        int refused = 0;
        for (int i = 0; i < 10; ++i) {
            const BoxSetup s = test_setups::random_setup(cell, random);
            PlacementOptions options;
            options.poses.step = 50;
            const std::vector<OrientationPoses> poses = milling_poses(s.setup, s.mesh, cell, options.poses);
            const MachineReachability reachability = place_block(s.setup, poses, cell, options);
            EXPECT_EQ(reachability.holds(), reachability.tightest().relative >= -1e-9);
            (reachability.holds() ? found : refused) += 1;
            if (reachability.holds()) {
                qchopper::Setup placed = s.setup;
                placed.placement = reachability.placement;
                EXPECT_TRUE(holds_at_placement(placed, poses, cell)) << cell.name << " " << i;
                // The stop rule asks for milling straight from above.
                placed.access.orientations.resize(1);
                EXPECT_TRUE(fits_machine(placed, s.mesh, cell)) << cell.name << " " << i;
            } else {
                EXPECT_FALSE(test_setups::scan_holds(s.setup, poses, cell, {200, 30})) << cell.name << " " << i;
            }
        }
        EXPECT_GT(found, 0) << cell.name;
        EXPECT_EQ(found + refused, 10);
    }
}

}  // namespace
}  // namespace qchopper
