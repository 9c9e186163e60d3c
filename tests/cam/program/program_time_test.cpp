// Times against those reckoned by hand.

#include "cam/program/program_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

ProgramSection straight(double length, double speed) {
    ProgramSection section;
    section.out = {0, 0, 1};
    section.link_feed = 300;
    section.runs = {{{0, 0, 0}, {}, {}, 300, true, {{{length, 0, 0}, MoveKind::cut, false, speed}}}};
    return section;
}

Cell gantry() {
    return test_programs::ready_cell("gantry-3axis.toml");
}

const double path_acceleration = ProgramSettings{}.acceleration;

TEST(ProgramTime, IsThatOfATrapezoidOrATriangle) {
    Program program;
    program.sections = {straight(1000, 100)};
    // 0.05 s to gain the speed and to lose it, 2.5 mm each.
    EXPECT_NEAR(program_time(program, gantry()).cut_s, 0.1 + 995 / 100.0, 1e-9);
    program.sections = {straight(2, 100)};
    EXPECT_NEAR(program_time(program, gantry()).cut_s, 2 * std::sqrt(2 / path_acceleration), 1e-9);
}

TEST(ProgramTime, StopsAtCornersThatAreNotRounded) {
    Program program;
    program.sections = {straight(1000, 100)};
    std::vector<ProgramMove>& moves = program.sections[0].runs[0].moves;
    moves = {{{500, 0, 0}, MoveKind::cut, false, 100}, {{1000, 0, 0}, MoveKind::cut, false, 100}};
    EXPECT_NEAR(program_time(program, gantry()).cut_s, 0.2 + 990 / 100.0, 1e-9);
    moves[0].is_rounded = true;
    program.sections[0].rounding = 1;
    EXPECT_NEAR(program_time(program, gantry()).cut_s, 0.1 + 995 / 100.0, 1e-9);
    // At a right angle with arms of 1 mm the parabola has a radius of 0.7071 mm.
    moves[1].tip = {500, 500, 0};
    const double corner = std::sqrt(path_acceleration * std::sqrt(0.5));
    const double lost = 2 * (100 - corner) / path_acceleration;
    const double ramps = 2 * (100 * 100 - corner * corner) / (2 * path_acceleration) + 5;
    EXPECT_NEAR(program_time(program, gantry()).cut_s, 0.1 + lost + (1000 - ramps) / 100, 1e-9);
}

TEST(ProgramTime, CountsToolChangesAndTableTurns) {
    const test_programs::Job job =
        test_programs::job_in(test_programs::ready_cell("kr120-r2500-pro-rotary.toml"), {300, 240, 200}, 40, 120);
    const Program program = test_programs::program_of(job);
    const ProgramTime time = program_time(program, job.cell);
    EXPECT_DOUBLE_EQ(time.change_s, 2 * tool_change_s);
    EXPECT_GT(time.joint_s, 5);
    EXPECT_GT(time.cut_s, time.cut_mm / job.cell.machine->tools[0].feed_max_mm_per_s);
    double turned = 0;
    double angle = 0;
    for (const ProgramSection& section : program.sections) {
        turned += std::abs(section.table_angle - angle);
        angle = section.table_angle;
    }
    turned += std::abs(angle);
    EXPECT_GT(time.table_s, turned / job.cell.machine->rotary_table->speed - 1e-9);
}

TEST(ProgramTime, OfAJointMoveIsThatOfItsSlowestAxis) {
    JointRanges ranges{};
    for (JointRange& range : ranges) range = {-3, 3, 2, 4};
    Joints to{};
    to[1] = 1;
    to[4] = -3;
    // At half of 2 rad/s and of 4 rad/s2: 0.5 s and 0.25 rad at each end.
    EXPECT_NEAR(joint_move_s(ranges, 0.5, {}, to), 1 + 2.5, 1e-12);
}

}  // namespace
}  // namespace qchopper
