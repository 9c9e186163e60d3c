// Directions that the arm holds: against a plain loop over the joints, and what must hold of every cell.

#include "cam/setup/reachable_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <random>

#include "cam/cell/reach_map.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double spoil = 10;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

std::vector<Cell> ready_cells() {
    return {ready_cell("kr60-ha.toml"), ready_cell("irb6640-185-2.8.toml"), ready_cell("kr120-r2500-pro-rotary.toml"),
            ready_cell("gantry-3axis.toml")};
}

// Unit vectors up to 90 degrees from straight up, straight up among them.
std::vector<Vec3> directions(std::size_t count, unsigned seed) {
    std::vector<Vec3> all{{0, 0, 1}};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> height(0, 1);
    std::uniform_real_distribution<double> angle(-pi, pi);
    while (all.size() < count) {
        const double z = height(random);
        const double a = angle(random);
        all.push_back({std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z});
    }
    return all;
}

std::size_t held(const std::vector<std::uint8_t>& flags) {
    return std::accumulate(flags.begin(), flags.end(), std::size_t{0});
}

Box box_of(Vec3 size) {
    return {{-size.x / 2, -size.y / 2, 0}, {size.x / 2, size.y / 2, size.z}};
}

// Poses of the flange as the header states them, without reach_map.h: the tool axis from the direction, turned about
// itself in steps of 30 degrees.
bool is_held_plainly(const Cell& cell, const Pose& setup, const Box& box, Vec3 direction) {
    const Robot& robot = *cell.machine->robot;
    const CuttingTool* tool = &cell.machine->tools.front();
    for (const CuttingTool& other : cell.machine->tools) {
        if (other.stick_out > tool->stick_out) tool = &other;
    }
    const ToolArm arm = tool_arm(robot, cell.machine->spindle, *tool);
    const Vec3 z = rotate(setup, -direction);
    const Vec3 level = std::hypot(z.x, z.y) > 1e-9 ? normalized(Vec3{-z.y, z.x, 0}) : Vec3{0, 1, 0};
    std::vector<Vec3> points{box.centre()};
    for (const double x : {box.min.x, box.max.x}) {
        for (const double y : {box.min.y, box.max.y}) {
            for (const double top : {box.min.z, box.max.z}) {
                const bool faces = (x == box.max.x ? direction.x : -direction.x) > 1e-9 ||
                                   (y == box.max.y ? direction.y : -direction.y) > 1e-9 ||
                                   (top == box.max.z ? direction.z : -direction.z) > 1e-9;
                if (faces) points.push_back({x, y, top});
            }
        }
    }
    for (const Vec3& point : points) {
        bool any = false;
        for (int turn = 0; turn < 12 && !any; ++turn) {
            // Columns of the pose of the tip: x, y, z.
            const double a = turn * pi / 6;
            const Vec3 across = cross(level, z);
            const Vec3 x = std::cos(a) * across + std::sin(a) * level;
            const Vec3 y = cross(z, x);
            const Pose tip{{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, apply(setup, point)};
            const Pose flange = inverse(robot.base_in_cell) * tip * inverse(arm.tip_in_flange);
            any = !inverse_within(arm.geometry, arm.ranges, arm.margin, flange).empty();
        }
        if (!any) return false;
    }
    return true;
}

Pose about_table(const RotaryTable& table, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Pose turn{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
    return table.table_in_cell * turn * Pose{Pose{}.row, {0, 0, spoil}};
}

TEST(ReachableDirections, AreThoseOfAPlainLoopOverJoints) {
    for (const Cell& cell : ready_cells()) {
        if (!cell.machine->robot) continue;
        for (const Vec3 size : {Vec3{100, 80, 60}, Vec3{600, 400, 400}}) {
            const Box box = box_of(size);
            const std::vector<Vec3> asked = directions(60, 7);
            const std::vector<std::uint8_t> flags = reachable_directions(cell, box, spoil, asked);
            for (std::size_t i = 0; i < asked.size(); ++i) {
                bool expected = false;
                const auto& table = cell.machine->rotary_table;
                if (!table) expected = is_held_plainly(cell, setup_in_cell(cell, spoil), box, asked[i]);
                if (table) {
                    const Vec3 base = apply_inverse(table->table_in_cell, cell.machine->robot->base_in_cell.shift);
                    const double own = std::atan2(asked[i].y, asked[i].x);
                    const double towards = std::atan2(base.y, base.x) - own;
                    std::vector<double> angles{towards, towards + pi};
                    for (int k = 0; k < 24; ++k) angles.push_back(k * pi / 12);
                    for (const double angle : angles) {
                        expected = expected || is_held_plainly(cell, about_table(*table, angle), box, asked[i]);
                    }
                }
                EXPECT_EQ(flags[i] != 0, expected)
                    << cell.name << " " << asked[i].x << " " << asked[i].y << " " << asked[i].z << ", box " << size.x;
            }
        }
    }
}

TEST(ReachableDirections, StraightUpIsHeldInEveryReadyCell) {
    for (const Cell& cell : ready_cells()) {
        const std::vector<Vec3> up{{0, 0, 1}};
        EXPECT_EQ(held(reachable_directions(cell, box_of({200, 150, 100}), spoil, up)), 1U) << cell.name;
    }
}

TEST(ReachableDirections, NarrowerRangesOfJointsNeverHoldMore) {
    for (Cell cell : ready_cells()) {
        if (!cell.machine->robot) continue;
        const std::vector<Vec3> asked = directions(150, 5);
        const Box box = box_of({300, 300, 200});
        const std::vector<std::uint8_t> before = reachable_directions(cell, box, spoil, asked);
        for (JointRange& range : cell.machine->robot->ranges) {
            const double less = 0.1 * (range.max - range.min);
            range.min += less;
            range.max -= less;
        }
        const std::vector<std::uint8_t> after = reachable_directions(cell, box, spoil, asked);
        for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_LE(after[i], before[i]) << cell.name;
        EXPECT_LT(held(after), held(before)) << cell.name;
    }
}

TEST(ReachableDirections, LargerBoxesNeverHoldMore) {
    for (const Cell& cell : ready_cells()) {
        if (!cell.machine->robot || cell.machine->rotary_table) continue;
        const std::vector<Vec3> asked = directions(150, 11);
        const std::size_t small = held(reachable_directions(cell, box_of({50, 50, 50}), spoil, asked));
        const std::size_t large = held(reachable_directions(cell, box_of({800, 800, 600}), spoil, asked));
        EXPECT_LE(large, small) << cell.name;
    }
}

// A point on the axis of the table: what matters is the tilt alone.
TEST(ReachableDirections, ARotaryTableMakesHoldingIndependentOfTheAzimuth) {
    const Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    bool some = false;
    bool all = true;
    for (int i = 0; i < 57; ++i) {
        const int tilt = 5 * (i % 19);
        const int storey = i / 19;
        const double z = 150.0 + 700.0 * storey;
        const Box point{{0, 0, z}, {0, 0, z}};
        std::vector<Vec3> asked;
        for (int azimuth = 0; azimuth < 24; ++azimuth) {
            const double t = tilt * pi / 180;
            const double a = azimuth * pi / 12;
            asked.push_back({std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)});
        }
        const std::size_t count = held(reachable_directions(cell, point, spoil, asked));
        EXPECT_TRUE(count == 0 || count == asked.size()) << "tilt " << tilt << " at " << z << ": " << count;
        some = some || count > 0;
        all = all && count > 0;
    }
    EXPECT_TRUE(some);
    EXPECT_FALSE(all);
}

// What is asked before does not change an answer.
TEST(ReachableDirections, DoNotDependOnTheirOrder) {
    for (const Cell& cell : ready_cells()) {
        std::vector<Vec3> asked = directions(100, 13);
        const Box box = box_of({500, 300, 250});
        std::vector<std::uint8_t> flags = reachable_directions(cell, box, spoil, asked);
        std::reverse(asked.begin(), asked.end());
        std::reverse(flags.begin(), flags.end());
        EXPECT_EQ(reachable_directions(cell, box, spoil, asked), flags) << cell.name;
    }
}

TEST(ReachableDirections, AGantryHoldsStraightUpAlone) {
    const std::vector<Vec3> asked{{0, 0, 1}, normalized({0.01, 0, 1}), {1, 0, 0}, {0, 0, -1}};
    const std::vector<std::uint8_t> expected{1, 0, 0, 0};
    EXPECT_EQ(reachable_directions(ready_cell("gantry-3axis.toml"), box_of({100, 100, 100}), spoil, asked), expected);
}

TEST(ReachableDirections, ACellOfVersion1HoldsAll) {
    const std::vector<Vec3> asked = directions(20, 1);
    const Cell cell = ready_cell("foam-1.toml");
    EXPECT_EQ(held(reachable_directions(cell, box_of({100, 100, 100}), spoil, asked)), asked.size());
}

TEST(SetupInCell, StandsOnTheSpoilLayerOverTheMiddleOfTheTable) {
    const Cell fixed = ready_cell("kr60-ha.toml");
    const Vec3 middle{fixed.table.centre_x, fixed.table.centre_y, fixed.table.height + spoil};
    EXPECT_EQ(setup_in_cell(fixed, spoil).shift, middle);
    const Cell rotary = ready_cell("kr120-r2500-pro-rotary.toml");
    const Vec3 on_table = rotary.machine->rotary_table->table_in_cell.shift + Vec3{0, 0, spoil};
    EXPECT_EQ(setup_in_cell(rotary, spoil).shift, on_table);
}

}  // namespace
}  // namespace qchopper
