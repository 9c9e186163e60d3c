// What the arms of the ready cells hold of holes in a block, and where the table turns for them.

#include "cam/program/reachable_holes.h"

#include <gtest/gtest.h>

#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using namespace test_programs;

// Holes of 8 mm from outs, as if they began in the block's upper part.
Drilling holes_along(const Job& job, const std::vector<Vec3>& tool_axes) {
    Drilling drilling;
    for (std::size_t i = 0; i < tool_axes.size(); ++i) {
        const Vec3 mouth{0, 0, 0.5 * job.setup.block.size.z};
        drilling.holes.push_back({i + 1, mouth, tool_axes[i], 8, 22, 6, {}});
        Operation made = operation(job, 0, 4, 15);
        made.kind = OperationKind::drilling;
        made.orientation = job.setup.access.orientations.size() + i;
        made.feed = job.cell.machine->tools[4].feed_max_mm_per_s;
        made.retract = highest(job.setup, tool_axes[i], job.cell.clearance);
        const Vec3 start = mouth + (made.retract - dot(mouth, tool_axes[i])) * tool_axes[i];
        made.runs = {{start,
                      {{mouth + 5 * tool_axes[i], MoveKind::link, false},
                       {mouth - 22 * tool_axes[i], MoveKind::cut, false},
                       {start, MoveKind::retract, false}},
                      i + 1}};
        drilling.orientations.push_back({tool_axes[i], 0});
        drilling.operations.push_back(made);
    }
    return drilling;
}

Toolpath with(const Toolpath& path, const Drilling& drilling) {
    Toolpath all = path;
    all.operations.insert(all.operations.end(), drilling.operations.begin(), drilling.operations.end());
    return all;
}

TEST(ReachableHoles, TheArmHoldsWhatItsProgramThenDrills) {
    for (const char* name : {"kr60-ha.toml", "kr120-r2500-pro-rotary.toml"}) {
        Job job = job_in(ready_cell(name), {200, 160, 120}, 30, 40);
        Drilling drilling = holes_along(job, {test_setups::tool_axis(25, -140), test_setups::tool_axis(10, 100)});
        keep_reachable_holes(drilling, job.setup, job.reachability, job.cell);
        ASSERT_EQ(drilling.operations.size(), 2U) << name << ": " << drilling.holes[0].by_hand;
        const qchopper::Setup setup = with_drill_orientations(job.setup, drilling.orientations);
        const Program program = make_program(with(job.toolpath, drilling), setup, job.reachability, job.cell);
        const ProgramOperation& last = program.operations.back();
        EXPECT_EQ(last.orientation, job.setup.access.orientations.size() + 1);
        ASSERT_EQ(last.runs.size(), 1U);
        EXPECT_EQ(last.runs.front().hole, 2U);
        EXPECT_LT(norm(last.tool_axis - test_setups::tool_axis(10, 100)), 1e-12);
        EXPECT_EQ(last.table_angle, drilling.orientations[1].table_angle);
        EXPECT_EQ(setup.placement.table_angles.size(),
                  job.cell.machine->rotary_table ? setup.access.orientations.size() : 0);
    }
}

TEST(ReachableHoles, WhatTheArmDoesNotHoldIsForTheHandAndItsDirectionGoes) {
    Job job = job_in(ready_cell("kr60-ha.toml"), {200, 160, 120}, 30, 40);
    Drilling drilling = holes_along(job, {{0, 0, -1}, test_setups::tool_axis(10, 100)});
    keep_reachable_holes(drilling, job.setup, job.reachability, job.cell);
    EXPECT_NE(drilling.holes[0].by_hand.find("the arm does not hold it: "), std::string::npos);
    EXPECT_EQ(drilling.holes[1].by_hand, "");
    ASSERT_EQ(drilling.operations.size(), 1U);
    ASSERT_EQ(drilling.orientations.size(), 1U);
    EXPECT_EQ(drilling.operations.front().orientation, job.setup.access.orientations.size());
    EXPECT_EQ(drilling.orientations.front().tool_axis, test_setups::tool_axis(10, 100));
}

}  // namespace
}  // namespace qchopper
