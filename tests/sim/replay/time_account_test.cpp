// Where the time of a program goes: examples with a closed form, sums, and a script that reads the text on its own.

#include "sim/replay/time_account.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "sim/replay/replay.h"
#include "sim/replay/walk/machine_walk.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

constexpr double cycle = 0.012;

TipLine some_line(Vec3 from, Vec3 to, double feed = 100, double acceleration = 1000) {
    TipLine line;
    line.from = from;
    line.to = to;
    line.feed = feed;
    line.acceleration = acceleration;
    return line;
}

// One line behind the other, of one tool.
ToolPath path_through(const std::vector<Vec3>& points, double rounding, double feed = 100, double acceleration = 1000) {
    ToolPath path;
    path.uses = {{"finishing", 0}};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        path.lines.push_back(some_line(points[i], points[i + 1], feed, acceleration));
        path.lines.back().rounding = rounding;
        path.lines.back().follows_line = i > 0;
        path.order.push_back({true, i});
    }
    return path;
}

// A tool up to 120 mm/s, and no arm.
CellMachine some_machine(double cycle_s) {
    CellMachine machine;
    machine.tools.resize(1);
    machine.tools[0].number = 7;
    machine.tools[0].feed_max_mm_per_s = 120;
    machine.tools[0].removal_mm3_per_s = 24'000;
    machine.program.interpolation_cycle_s = cycle_s;
    return machine;
}

std::vector<MachineTime> account(const ToolPath& path, const CellMachine& machine, std::vector<LineCut> cuts = {}) {
    MillingFigures milling;
    milling.lines = std::move(cuts);
    milling.lines.resize(path.lines.size());
    return account_of(path, time_of(path, motion_limits(machine)), milling, machine);
}

TEST(TimeAccount, ALineFromRestToRestTakesItsRampsBeyondItsFeed) {
    const ToolPath path = path_through({{0, 0, 0}, {100, 0, 0}}, 0);
    const std::vector<MachineTime> made = account(path, some_machine(0), {{true, 500}});
    ASSERT_EQ(made.size(), 1U);
    const MachineTime& row = made[0];
    EXPECT_EQ(row.operation, "finishing");
    EXPECT_EQ(row.tool, 7);
    EXPECT_EQ(row.tool_mm3_per_s, 24'000);
    EXPECT_NEAR(row.cutting_s, 1, 1e-12);         // L / v
    EXPECT_NEAR(row.acceleration_s, 0.1, 1e-12);  // v / a
    EXPECT_EQ(row.air_s + row.link_s + row.joint_move_s + row.tool_change_s, 0);
    EXPECT_EQ(row.cutting_mm, 100);
    EXPECT_EQ(row.removed_mm3, 500);
    EXPECT_EQ(row.lines, 1U);
    EXPECT_EQ(row.stops, 1U);
    EXPECT_EQ(row.short_lines, 0U);
}

TEST(TimeAccount, ASquareStopsAtEachExactCorner) {
    const std::vector<Vec3> square{{0, 0, 0}, {50, 0, 0}, {50, 50, 0}, {0, 50, 0}, {0, 0, 0}};
    const MachineTime exact = sum_of(account(path_through(square, 0), some_machine(cycle)));
    EXPECT_NEAR(exact.air_s, 4 * 0.5, 1e-12);
    EXPECT_NEAR(exact.acceleration_s, 4 * 0.1, 1e-12);
    EXPECT_EQ(exact.stops, 4U);
    const MachineTime rounded = sum_of(account(path_through(square, 2), some_machine(cycle)));
    EXPECT_EQ(rounded.stops, 1U);
    // The parabola with sides of 2 mm has a radius of 2 * (1/2) / sqrt(1/2) in its middle.
    const double corner = std::sqrt(1000 * 2 * std::sqrt(0.5));
    const double ramp = (100 - corner) * (100 - corner) / (2 * 1000 * 100);  // beyond the time at feed
    EXPECT_NEAR(rounded.acceleration_s, 2 * 0.05 + 6 * ramp, 1e-12);
}

TEST(TimeAccount, ALineTakesACycleAtLeast) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 100; ++i) points.push_back({0.5 * i, 0, 0});
    const ToolPath path = path_through(points, 0.2, 100, 20'000);
    const MachineTime row = sum_of(account(path, some_machine(cycle)));
    EXPECT_EQ(row.short_lines, 100U);
    EXPECT_EQ(row.stops, 1U);
    EXPECT_NEAR(row.seconds(), 100 * cycle, 1e-12);
    EXPECT_EQ(sum_of(account(path, some_machine(0.005))).short_lines, 0U) << "0.5 mm are 5 ms at 100 mm/s";
    EXPECT_LT(sum_of(account(path, some_machine(0))).seconds(), 0.51);
}

TEST(TimeAccount, LinesFasterThanTheWindowAreLinks) {
    ToolPath path = path_through({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}}, 0);
    path.lines[1].feed = 120.1;  // within the tolerance of the window
    path.lines[2].feed = 200;
    const MachineTime row = sum_of(account(path, some_machine(cycle), {{true, 10}, {false, 0}, {false, 0}}));
    EXPECT_EQ(row.cutting_mm, 100);
    EXPECT_EQ(row.air_mm, 100);
    EXPECT_EQ(row.link_mm, 100);
    EXPECT_NEAR(row.cutting_s, 1, 1e-12);
    EXPECT_NEAR(row.air_s, 100 / 120.1, 1e-12);
    EXPECT_NEAR(row.link_s, 0.5, 1e-12);
}

TEST(TimeAccount, JointMovesAndToolChangesCountForTheirOperation) {
    ToolPath path = path_through({{0, 0, 0}, {100, 0, 0}}, 0);
    path.uses.push_back({"drilling", 0});
    JointSweep sweep;
    sweep.seconds = 3;
    path.sweeps = {sweep, sweep};
    path.sweeps[1].use = 1;
    path.tool_changes = {{0, 0}, {1, 0}, {1, 0}};
    CellMachine machine = some_machine(cycle);
    machine.program.tool_change_s = 45;
    const std::vector<MachineTime> made = account(path, machine);
    ASSERT_EQ(made.size(), 2U);
    EXPECT_EQ(made[1].operation, "drilling");
    EXPECT_EQ(made[1].joint_move_s, 3);
    EXPECT_EQ(made[1].tool_change_s, 90);
    EXPECT_EQ(made[1].tool_changes, 2U);
    EXPECT_NEAR(sum_of(made).seconds(), 1.1 + 6 + 3 * 45, 1e-12);
    EXPECT_NEAR(time_of(path, motion_limits(machine)).seconds, sum_of(made).seconds(), 1e-12);
}

TEST(PathTime, AxesBoundAccelerationAndCorners) {
    MotionLimits limits;
    limits.axis_acceleration[2] = 1;
    JointRates rates{};
    rates[2] = -0.002F;
    EXPECT_NEAR(tip_acceleration(rates, limits), 500, 1e-4);
    rates[2] = 0;
    rates[3] = 1;
    EXPECT_TRUE(std::isinf(tip_acceleration(rates, limits))) << "axis 4 may do anything";
    ToolPath path = path_through({{0, 0, 0}, {100, 0, 0}, {200, 0.001, 0}}, 1);
    EXPECT_NEAR(time_of(path, limits).lines[0].end_speed, 100, 1e-9);
    path.lines[0].last_rates[2] = 0.001F;
    path.lines[1].first_rates[2] = -0.001F;
    // Its speed changes by 0.002 v in 2 mm / v.
    EXPECT_NEAR(time_of(path, limits).lines[0].end_speed, std::sqrt(2 * 1 / 0.002), 1e-4);
}

// Two kinds of operation, of which one has two tools, and runs of short lines in the air.
BoxJob long_job(const std::string& cell) {
    BoxJob job = box_job(cell);
    job.job.chunks[0].operation = "roughing";
    WrittenChunk ball{3, 0, 15000, {}, "fine finishing"};
    ball.moves.push_back({{0, 0, 50}, 300, false});
    for (int i = 0; i <= 400; ++i) {
        const double turn = 0.05 * i;
        ball.moves.push_back({{20 * std::cos(turn), 15 * std::sin(turn), 45 + 0.005 * i}, 60, i % 50 > 0 && i < 400});
    }
    ball.moves.push_back({{0, 0, 60}, 300, false});
    job.job.chunks.push_back(ball);
    WrittenChunk again = job.job.chunks[0];
    job.job.chunks.push_back(again);
    again.tool = 3;
    job.job.chunks.push_back(again);
    return job;
}

class TimeAccountOf : public testing::TestWithParam<std::string> {};

TEST_P(TimeAccountOf, AProgramAddsUp) {
    const BoxJob job = long_job(GetParam());
    ReplayOptions options;
    options.cell = 1;
    const ReplayReport report = replay(read_back(job, job.files()), job.scene(), options);
    std::vector<std::string> rows;
    for (const MachineTime& row : report.account) rows.push_back(row.operation + " " + std::to_string(row.tool));
    EXPECT_EQ(rows, (std::vector<std::string>{"roughing 2", "unknown 2", "fine finishing 3", "roughing 3"}));
    const MachineTime sum = sum_of(report.account);
    EXPECT_NEAR(sum.seconds(), report.time.seconds, 1e-6);
    EXPECT_NEAR(sum.line_mm(), report.time.line_mm, 1e-6);
    EXPECT_NEAR(sum.cutting_mm + sum.air_mm, report.milling.feed_mm, 1e-6);
    EXPECT_NEAR(sum.air_mm, report.milling.air_mm, 1e-6);
    EXPECT_NEAR(sum.removed_mm3, report.milling.removed_mm3, 1e-6 * report.milling.removed_mm3);
    EXPECT_EQ(sum.tool_changes, 4U);
    EXPECT_GT(report.account[0].cutting_s, 1);
    EXPECT_GT(report.account[0].removed_mm3, 1e4);
    EXPECT_EQ(report.account[2].cutting_mm, 0) << "it is in the air";
    EXPECT_EQ(report.account[2].removed_mm3, 0);
    EXPECT_GT(report.account[2].short_lines, 0U);
    EXPECT_EQ(sum.lines, report.time.lines.size());
}

ToolPath walked(const BoxJob& job) {
    FindingLog log;
    return walk_machine(read_back(job, job.files()), job.scene(), log, {});
}

TEST_P(TimeAccountOf, NoAxisExceedsItsAcceleration) {
    const BoxJob job = long_job(GetParam());
    const ToolPath path = walked(job);
    const double quick = time_of(path, motion_limits(*job.cell.machine)).seconds;
    std::size_t turning = 0;
    for (const TipLine& line : path.lines) {
        for (const JointRates& rates : {line.first_rates, line.last_rates}) {
            EXPECT_LE(line.acceleration, tip_acceleration(rates, motion_limits(*job.cell.machine)) * (1 + 1e-9));
            turning += rates[0] != 0;
        }
        EXPECT_LE(line.acceleration, 2000);
    }
    EXPECT_GT(turning, path.lines.size()) << "rates are known";
    BoxJob lazy = job;
    lazy.cell.machine->robot->ranges[0].acceleration *= 0.05;
    const ToolPath slow = walked(lazy);
    std::size_t bounded = 0;
    for (std::size_t i = 0; i < path.lines.size(); ++i)
        bounded += slow.lines[i].acceleration < path.lines[i].acceleration;
    EXPECT_GT(bounded, path.lines.size() / 10);
    ToolPath lines_alone = slow;
    lines_alone.sweeps = path.sweeps;
    EXPECT_GT(time_of(lines_alone, motion_limits(*lazy.cell.machine)).seconds, quick + 1);
}

// A row of the script: its numbers in the order of COLUMNS.
struct ReferenceRow {
    std::uint16_t tool = 0;
    double at_feed_s = 0;
    double link_s = 0;
    double acceleration_s = 0;
    double joint_move_s = 0;
    double tool_change_s = 0;
    double at_feed_mm = 0;
    double link_mm = 0;
    std::size_t lines = 0;
    std::size_t stops = 0;
    std::size_t short_lines = 0;
    std::size_t tool_changes = 0;
    std::string operation;
};

std::vector<ReferenceRow> reference_rows(const BoxJob& job, const std::string& cell) {
    const TemporaryFolder folder("qchopper-account-");
    for (const ProgramFile& file : job.files()) {
        std::ofstream(folder.path() / file.name, std::ios::binary) << file.text;
    }
    const std::string source = QCHOPPER_SOURCE_DIR;
    const std::filesystem::path out = folder.path() / "rows.txt";
    const std::string command = "python3 -B '" + source + "/tests/sim/replay/time_account_reference.py' '" + source +
                                "/cells/" + cell + ".toml' '" + folder.path().string() + "' > '" + out.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::vector<ReferenceRow> rows;
    std::ifstream stream(out);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        ReferenceRow r;
        words >> r.tool >> r.at_feed_s >> r.link_s >> r.acceleration_s >> r.joint_move_s >> r.tool_change_s >>
            r.at_feed_mm >> r.link_mm >> r.lines >> r.stops >> r.short_lines >> r.tool_changes >> std::ws;
        std::getline(words, r.operation);
        rows.push_back(r);
    }
    return rows;
}

void expect_within(double value, double reference, const std::string& what) {
    EXPECT_NEAR(value, reference, 0.05 * reference + 0.01) << what;
}

TEST_P(TimeAccountOf, AgreesWithAScriptThatReadsTheText) {
    const BoxJob job = long_job(GetParam());
    const std::vector<MachineTime> made = account(walked(job), *job.cell.machine);
    const std::vector<ReferenceRow> expected = reference_rows(job, GetParam());
    ASSERT_EQ(made.size(), expected.size());
    double joint_move_s = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const MachineTime& row = made[i];
        const ReferenceRow& reference = expected[i];
        const std::string name = row.operation + " " + std::to_string(row.tool) + ": ";
        EXPECT_EQ(row.operation, reference.operation);
        EXPECT_EQ(row.tool, reference.tool);
        expect_within(row.cutting_s + row.air_s, reference.at_feed_s, name + "at feed");
        expect_within(row.link_s, reference.link_s, name + "links");
        expect_within(row.acceleration_s, reference.acceleration_s, name + "acceleration");
        expect_within(row.line_s() + row.joint_move_s,
                      reference.at_feed_s + reference.link_s + reference.acceleration_s + reference.joint_move_s,
                      name + "all but tool changes");
        joint_move_s += reference.joint_move_s;
        EXPECT_EQ(row.tool_change_s, reference.tool_change_s);
        EXPECT_EQ(row.tool_changes, reference.tool_changes);
        expect_within(row.cutting_mm + row.air_mm, reference.at_feed_mm, name + "mm at feed");
        expect_within(row.link_mm, reference.link_mm, name + "mm of links");
        EXPECT_EQ(row.lines, reference.lines);
        EXPECT_EQ(row.stops, reference.stops);
        EXPECT_EQ(row.short_lines, reference.short_lines);
    }
    // The script knows no joints at the end of a line.
    EXPECT_NEAR(sum_of(made).joint_move_s, joint_move_s, 0.1 * joint_move_s);
}

INSTANTIATE_TEST_SUITE_P(Cells, TimeAccountOf, testing::Values("kr60-ha", "kr120-r2500-pro-rotary"),
                         [](const auto& tested) { return tested.param == "kr60-ha" ? "Fixed" : "Rotary"; });

}  // namespace
}  // namespace qchopper
