// Every pose of a program is asked of the arm again, by the plain functions of cam/cell.

#include "cam/program/make_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "base/parallel.h"
#include "cam/cell/machine_bodies.h"
#include "cam/cell/reach_map.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using test_programs::Job;
using test_programs::job_in;
using test_programs::program_of;
using test_programs::ready_cell;

constexpr double degree = std::numbers::pi / 180;

Job kr60_job(double step = 15) {
    return job_in(ready_cell("kr60-ha.toml"), {250, 200, 150}, 35, 200, step);
}

Job rotary_job(double step = 15) {
    return job_in(ready_cell("kr120-r2500-pro-rotary.toml"), {300, 240, 200}, 40, 120, step);
}

// The joints that hold a tip of an operation, of the configuration of the operation and nearest to the ones given.
std::optional<Joints> joints_at(const Job& job, const ProgramOperation& operation, Vec3 tip, const Joints& near) {
    const CellMachine& machine = *job.cell.machine;
    const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[operation.tool]);
    const Pose setup =
        table_in_cell(job.cell, operation.table_angle) * setup_in_table(job.setup.placement, job.setup.spoil);
    const Pose tip_in_cell = setup * tip_frame(tip, operation.tool_axis, operation.redundancy_angle);
    const Pose flange = inverse(arm.base_in_cell) * tip_in_cell * inverse(arm.tip_in_flange);
    for (const ArmAnswer& answer : inverse(arm.geometry, flange, near)) {
        if (!(answer.configuration == operation.configuration)) continue;
        Joints joints = answer.joints;
        for (std::size_t i = 0; i < axes_of_arm; ++i) {
            joints[i] += 2 * std::numbers::pi * std::nearbyint((near[i] - joints[i]) / (2 * std::numbers::pi));
        }
        return joints;
    }
    return std::nullopt;
}

double largest_step(const Joints& a, const Joints& b) {
    double largest = 0;
    for (std::size_t i = 0; i < axes_of_arm; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

// What is nearest to what for joints: arm and tool against block, floor and obstacles.
double clearance_at(const Job& job, const ProgramOperation& operation, const Joints& joints, bool with_tool) {
    const MovingBodies moving = bodies_at(job.cell, job.cell.machine->tools[operation.tool], joints);
    const StandingBodies standing = standing_bodies(job.cell);
    const Vec3 half{0.5 * job.setup.block.size.x, 0.5 * job.setup.block.size.y, 0};
    const Pose setup =
        table_in_cell(job.cell, operation.table_angle) * setup_in_table(job.setup.placement, job.setup.spoil);
    const PlacedBox block = placed(
        setup, {-half - Vec3{0, 0, job.setup.spoil}, half + Vec3{0, 0, job.setup.block.size.z - job.setup.spoil}});
    double least = std::numeric_limits<double>::infinity();
    for (const LinkCapsule& link : moving.links) {
        least = std::min(least, distance(link.shape, block));
        for (const PlacedBox& obstacle : standing.obstacles) least = std::min(least, distance(link.shape, obstacle));
    }
    for (const AxisBody& body : moving.on_axis) {
        if (with_tool) least = std::min(least, distance(body.shape, block));
        for (const PlacedBox& obstacle : standing.obstacles) least = std::min(least, distance(body.shape, obstacle));
    }
    return least;
}

void expect_way_clear(const Job& job, const ProgramOperation& operation, std::vector<Joints> way) {
    for (std::size_t i = 1; i < way.size(); ++i) {
        const int steps = 1 + static_cast<int>(largest_step(way[i - 1], way[i]) / (1 * degree));
        for (int k = 0; k <= steps; ++k) {
            Joints joints = way[i];
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                joints[axis] = way[i - 1][axis] + k * (way[i][axis] - way[i - 1][axis]) / steps;
            }
            ASSERT_GT(clearance_at(job, operation, joints, true), 8);
        }
    }
}

// Limits, continuity, speed and clearance of every move, and of what is between.
void expect_held(const Job& job, const Program& program) {
    const CellMachine& machine = *job.cell.machine;
    for (const ProgramOperation& operation : program.operations) {
        const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[operation.tool]);
        Joints at = operation.runs.front().start_joints;
        Vec3 tip = operation.runs.front().start;
        const auto go = [&](Vec3 to, double speed) {
            const int steps = 1 + static_cast<int>(norm(to - tip) / 7);
            for (int i = 1; i <= steps; ++i) {
                const std::optional<Joints> next = joints_at(job, operation, tip + (1.0 * i / steps) * (to - tip), at);
                ASSERT_TRUE(next);
                ASSERT_TRUE(is_within(arm.ranges, arm.margin - 1e-9, *next));
                ASSERT_GT(clearance_at(job, operation, *next, false), 9.9);
                for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                    const double seconds = norm(to - tip) / steps / speed;
                    ASSERT_LE(std::abs((*next)[axis] - at[axis]), 1.02 * arm.ranges[axis].speed * seconds + 1e-6);
                }
                at = *next;
            }
            tip = to;
        };
        for (const ProgramRun& run : operation.runs) {
            go(run.start, run.link_speed);
            EXPECT_LT(largest_step(at, run.start_joints), 1e-6);
            for (const ProgramMove& move : run.moves) go(move.tip, move.speed);
            EXPECT_LT(largest_step(at, run.end_joints), 1e-6);
        }
        std::vector<Joints> way{program.home};
        way.insert(way.end(), operation.entry.targets.begin(), operation.entry.targets.end());
        expect_way_clear(job, operation, way);
        const Vec3 retracted = operation.runs.front().start + operation.entry.retract * operation.tool_axis;
        const std::optional<Joints> start = joints_at(job, operation, retracted, way.back());
        ASSERT_TRUE(start);
        EXPECT_LT(largest_step(*start, way.back()), 1e-6);
        ASSERT_FALSE(operation.exit.targets.empty());
        EXPECT_EQ(operation.exit.targets.back(), program.home);
        for (const ProgramRun& run : operation.runs) {
            if (run.starts_from_home) expect_way_clear(job, operation, {program.home, run.start_joints});
        }
        way = operation.exit.targets;
        const Vec3 end = operation.runs.back().moves.back().tip + operation.exit.retract * operation.tool_axis;
        const std::optional<Joints> retracted_end = joints_at(job, operation, end, operation.runs.back().end_joints);
        ASSERT_TRUE(retracted_end);
        way.insert(way.begin(), *retracted_end);
        expect_way_clear(job, operation, way);
    }
}

// All moves of all program operations of a toolpath operation, in their order, without what a division of runs added.
std::vector<Vec3> cuts_of(const Program& program, std::size_t number) {
    std::vector<Vec3> tips;
    for (const ProgramOperation& operation : program.operations) {
        if (operation.toolpath_operation != number) continue;
        for (const ProgramRun& run : operation.runs) {
            for (const ProgramMove& move : run.moves) {
                if (move.kind == MoveKind::cut) tips.push_back(move.tip);
            }
        }
    }
    return tips;
}

std::vector<Vec3> cuts_of(const Operation& operation) {
    std::vector<Vec3> tips;
    for (const PathRun& run : operation.runs) {
        for (const PathMove& move : run.moves) {
            if (move.kind == MoveKind::cut) tips.push_back(move.tip);
        }
    }
    return tips;
}

TEST(MakeProgram, HoldsEveryPoseOfAFixedTable) {
    const Job job = kr60_job();
    const Program program = program_of(job);
    ASSERT_GE(program.operations.size(), 3U);
    expect_held(job, program);
    for (std::size_t i = 0; i < job.toolpath.operations.size(); ++i) {
        EXPECT_EQ(cuts_of(program, i), cuts_of(job.toolpath.operations[i]));
    }
    for (const ProgramOperation& operation : program.operations) {
        EXPECT_EQ(operation.kind, job.toolpath.operations[operation.toolpath_operation].kind);
    }
}

TEST(MakeProgram, HoldsEveryPoseOfARotaryTable) {
    const Job job = rotary_job();
    const Program program = program_of(job);
    expect_held(job, program);
    EXPECT_EQ(program.external_axis, 1);
    for (const ProgramOperation& operation : program.operations) {
        EXPECT_NEAR(std::remainder(operation.table_angle - job.setup.placement.table_angle(operation.orientation),
                                   2 * std::numbers::pi),
                    0, 1e-12);
    }
}

// The tool hangs beside the block at home, lower than its top: a turn of axis 1 alone would take it into the foam.
TEST(MakeProgram, GoesOverABlockThatIsHigherThanTheToolAtHome) {
    Job job = job_in(ready_cell("kr120-r2500-pro-rotary.toml"), {548, 213, 746}, 53, 114);
    job.setup.placement = {0, 300, 0, {120 * degree, 22 * degree}};
    job.reachability = {};
    const Program program = program_of(job);
    expect_held(job, program);
    const ProgramOperation& last = program.operations.back();
    ASSERT_EQ(last.orientation, 1U);
    ASSERT_GE(last.entry.targets.size(), 2U);
    EXPECT_NEAR(last.entry.targets.front()[0], program.home[0], 1e-6) << "straight up";
    ASSERT_GE(last.exit.targets.size(), 2U);
    EXPECT_EQ(last.exit.targets[last.exit.targets.size() - 2], last.entry.targets.front()) << "and down again";
}

TEST(MakeProgram, HoldsWithASkewTool) {
    Cell cell = ready_cell("kr60-ha.toml");
    cell.machine->spindle.spindle_in_flange = {tip_frame({}, normalized({0.3, -0.1, -1}), 0.4).row, {30, -20, 300}};
    const Job job = job_in(cell, {200, 160, 120}, 20, 140);
    const Program program = program_of(job);
    expect_held(job, program);
}

TEST(MakeProgram, DoesNotDependOnThreads) {
    const Job job = kr60_job();
    const Program many = program_of(job);
    const ThreadLimit one(1);
    EXPECT_EQ(program_of(job), many);
}

TEST(MakeProgram, DividesLongRuns) {
    Job job = kr60_job(2);
    job.cell.machine->program.lines_per_chunk = 300;
    const Program program = program_of(job);
    for (const ProgramOperation& operation : program.operations) {
        for (const ProgramRun& run : operation.runs) EXPECT_LE(run.moves.size(), 300U);
    }
    for (std::size_t i = 0; i < job.toolpath.operations.size(); ++i) {
        EXPECT_EQ(cuts_of(program, i), cuts_of(job.toolpath.operations[i]));
    }
    expect_held(job, program);
}

// Envelope regions are a hint: without them the search finds holds itself.
TEST(MakeProgram, FindsPosturesWithoutReachability) {
    Job job = kr60_job();
    job.reachability = {};
    expect_held(job, program_of(job));
}

TEST(MakeProgram, LowersSpeedsThatJointsCannotFollow) {
    Job job = kr60_job();
    for (JointRange& range : job.cell.machine->robot->ranges) range.speed *= 0.05;
    job.reachability = {};
    const Program program = program_of(job);
    std::size_t lowered = 0;
    for (const ProgramOperation& operation : program.operations) lowered += operation.lowered_moves;
    EXPECT_GT(lowered, 0U);
    expect_held(job, program);
}

// Axis 6 follows axis 1 while the tool keeps its orientation; cables that let it turn by 4 degrees carry no whole run.
TEST(MakeProgram, DividesRunsAmongConfigurations) {
    Job job = kr60_job();
    job.reachability = {};
    job.cell.machine->robot->cable->axis_6 = {-5 * degree, 5 * degree};
    job.toolpath.operations.pop_back();
    const Program program = program_of(job);
    EXPECT_GT(program.operations.size(), 2U);
    EXPECT_LT(program.operations.size(), 100U);
    for (std::size_t i = 0; i < job.toolpath.operations.size(); ++i) {
        EXPECT_EQ(cuts_of(program, i), cuts_of(job.toolpath.operations[i]));
    }
    expect_held(job, program);
}

TEST(MakeProgram, RefusesWhatIsOutOfReach) {
    Job job = kr60_job();
    job.setup.placement.x += 1500;
    try {
        program_of(job);
        FAIL();
    } catch (const ProgramRefused& refused) {
        const std::string what = refused.what();
        EXPECT_NE(what.find("operation 1 of the toolpath, run 1"), std::string::npos) << what;
        EXPECT_NE(what.find("mm"), std::string::npos) << what;
    }
}

TEST(MakeProgram, AnOperationIsRefusedByItselfInTheSameWords) {
    Job job = kr60_job();
    const auto refusal = [&job]() -> std::string {
        for (std::size_t i = 0; i < job.toolpath.operations.size(); ++i) {
            try {
                check_operation(job.toolpath.operations[i], i + 1, job.setup, job.reachability, job.cell);
            } catch (const ProgramRefused& refused) {
                EXPECT_TRUE(refused.run());
                return refused.what();
            }
        }
        return {};
    };
    EXPECT_EQ(refusal(), "");
    job.setup.placement.x += 1500;
    try {
        program_of(job);
        FAIL();
    } catch (const ProgramRefused& refused) {
        EXPECT_EQ(refusal(), refused.what());
    }
}

TEST(MakeProgram, LeavesOutTheLittleThatNoConfigurationTakes) {
    Job job = kr60_job(2);
    job.reachability = {};
    const Toolpath good = job.toolpath;
    std::vector<PathMove>& moves = job.toolpath.operations[1].runs[2].moves;
    moves[500].tip.z -= 170;  // through the table
    moves[501].tip.z -= 170;
    const Program program = program_of(job);
    EXPECT_EQ(cuts_of(program, 0), cuts_of(good.operations[0]));
    double length = 0;
    for (std::size_t i = 500; i <= 502; ++i) length += norm(moves[i].tip - moves[i - 1].tip);
    EXPECT_NEAR(program.left_out_mm, length, 1e-9);
    EXPECT_NE(program.left_out_because.find("operation 2 of the toolpath: "), std::string::npos);
    std::vector<Vec3> expected;
    for (const PathRun& run : job.toolpath.operations[1].runs) {
        for (const PathMove& move : run.moves) {
            const bool is_left_out = &move >= &moves[500] && &move <= &moves[502];
            if (move.kind == MoveKind::cut && !is_left_out) expected.push_back(move.tip);
        }
    }
    EXPECT_EQ(cuts_of(program, 1), expected);
    expect_held(job, program);

    for (PathMove& move : moves) {
        if (move.kind == MoveKind::cut) move.tip.z -= 170;
    }
    EXPECT_THROW(program_of(job), ProgramRefused) << "too much to leave out";
}

TEST(MakeProgram, RefusesBadToolpathsByName) {
    const Job good = kr60_job();
    const auto refusal = [&](const auto& spoil) {
        Job job = good;
        spoil(job.toolpath);
        try {
            program_of(job);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("not refused");
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos ? std::string() : text;
    };
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations.clear(); }), "is empty"), "");
    EXPECT_EQ(
        has(refusal([](Toolpath& t) { t.operations[1].runs.clear(); }), "operation 2 of the toolpath: has no runs"),
        "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].runs[1].moves.clear(); }), "run 2: has no moves"), "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].tool = 99; }), "tool is not in the cell file"), "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].orientation = 7; }), "orientation is not of the setup"),
              "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].feed = 900; }), "feed 900"), "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].rpm = 90; }), "speed of the spindle 90"), "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].runs[0].moves[3].tip.x = std::nan(""); }), "move 4"), "");
    EXPECT_EQ(has(refusal([](Toolpath& t) { t.operations[0].runs[0].start.y = 6000; }), "5 m"), "");
}

TEST(MakeProgram, StopsWhenCancelled) {
    const Job job = kr60_job();
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(make_program(job.toolpath, job.setup, job.reachability, job.cell, context), Cancelled);
}

TEST(MakeProgram, NeedsNoArm) {
    const Cell cell = ready_cell("gantry-3axis.toml");
    Job job = job_in(cell, {200, 150, 100}, 0, 0);
    const Program program = program_of(job);
    EXPECT_FALSE(program.has_arm);
    EXPECT_EQ(cuts_of(program, 0), cuts_of(job.toolpath.operations[0]));
    job.setup.placement.x += 5000;
    EXPECT_THROW(program_of(job), ProgramRefused);
}

TEST(LoadData, HasTheCentreBetweenSpindleAndTool) {
    const Cell cell = ready_cell("kr60-ha.toml");
    const Spindle& spindle = cell.machine->spindle;
    const CuttingTool& tool = cell.machine->tools[0];
    const LoadData load = load_data(spindle, tool);
    EXPECT_DOUBLE_EQ(load.mass_kg, 16.2);
    EXPECT_NEAR(load.centre_in_flange.shift.z, 350 + (15 * -175 + 1.2 * 100) / 16.2, 1e-9);
    EXPECT_NEAR(load.inertia_kg_m2.z, 15 * 0.09 * 0.09 / 2 + 1.2 * 0.02 * 0.02 / 2, 1e-12);
    EXPECT_GT(load.inertia_kg_m2.x, 15 * 0.35 * 0.35 / 12);
}

}  // namespace
}  // namespace qchopper
