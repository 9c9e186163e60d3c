// Emitted programs against the program that they were made from, and against the arm.

#include "cam/post/post.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "cam/cell/kuka_angles.h"
#include "tests/cam/post/scanned_krl.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using test_krl::scan;
using test_krl::ScannedLine;
using test_programs::Job;
using test_programs::job_in;
using test_programs::program_of;
using test_programs::ready_cell;

constexpr double degree = std::numbers::pi / 180;

Job fixed_job() {
    return job_in(ready_cell("kr60-ha.toml"), {250, 200, 150}, 35, 200);
}

Job rotary_job() {
    return job_in(ready_cell("kr120-r2500-pro-rotary.toml"), {300, 240, 200}, 40, 120);
}

// No frame is like another one, and the tool axis is x.
Job skew_job() {
    Cell cell = ready_cell("kr60-ha.toml");
    cell.machine->spindle.spindle_in_flange = pose_of({25 * degree, -80 * degree, 10 * degree}, {30, -20, 300});
    cell.machine->spindle.tool_axis = ToolAxis::x;
    cell.machine->robot->base_in_cell = pose_of({30 * degree, 2 * degree, -1 * degree}, {40, -60, 20});
    Job job = job_in(cell, {200, 160, 120}, 20, 140);
    return job;
}

Job skew_rotary_job() {
    Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    cell.machine->robot->base_in_cell = pose_of({-15 * degree, 1 * degree, 2 * degree}, {20, -30, 15});
    cell.machine->rotary_table->table_in_cell = pose_of({20 * degree, 0.4 * degree, -0.5 * degree}, {1450, 60, 300});
    cell.machine->spindle.spindle_in_flange = pose_of({5 * degree, -12 * degree, 8 * degree}, {10, -15, 330});
    return job_in(cell, {240, 180, 150}, 25, 100);
}

// The place of the block is searched once.
const std::vector<Job>& jobs() {
    static const std::vector<Job> all{fixed_job(), rotary_job(), skew_job(), skew_rotary_job()};
    return all;
}

Pose frame_of(const ScannedLine& line) {
    const auto& v = line.values;
    return pose_of({v.at("A") * degree, v.at("B") * degree, v.at("C") * degree}, {v.at("X"), v.at("Y"), v.at("Z")});
}

Joints joints_of(const ScannedLine& line) {
    Joints joints{};
    for (std::size_t i = 0; i < axes_of_arm; ++i) joints[i] = line.values.at("A" + std::to_string(i + 1)) * degree;
    return joints;
}

Vec3 tip_of(const ScannedLine& line) {
    return {line.values.at("X"), line.values.at("Y"), line.values.at("Z")};
}

// All lines of all chunks as they run, without those of the main program.
std::vector<ScannedLine> chunk_lines(const ProgramPart& part, const PostedChunk& chunk) {
    return scan(test_krl::resolved(part, test_krl::text_of(part, chunk.name)));
}

// The tips that a section's runs go to, as a chunk states them: starts, moves, and the start of the next run behind.
std::vector<Vec3> expected_tips(const Program& program, const PostedChunk& chunk) {
    const ProgramOperation& operation = program.operations[chunk.operation];
    std::vector<Vec3> tips;
    for (std::size_t r = chunk.first_run; r < chunk.first_run + chunk.runs; ++r) {
        tips.push_back(operation.runs[r].start);
        for (const ProgramMove& move : operation.runs[r].moves) tips.push_back(move.tip);
    }
    const std::size_t end = chunk.first_run + chunk.runs;
    if (end < operation.runs.size()) {
        tips.push_back(operation.runs[end].start);
    } else if (operation.exit.retract > 0) {
        tips.push_back(operation.runs.back().moves.back().tip + operation.exit.retract * operation.tool_axis);
    }
    return tips;
}

TEST(PostKrl, HasEveryMoveOfTheProgram) {
    for (const Job& job : jobs()) {
        const Program program = program_of(job);
        for (const ProgramPart& part : post_program(program, job.cell, {7})) {
            for (const PostedChunk& chunk : part.chunks) {
                std::vector<Vec3> tips;
                for (const ScannedLine& line : chunk_lines(part, chunk)) {
                    if (line.word == "LIN") tips.push_back(tip_of(line));
                }
                const std::vector<Vec3> expected = expected_tips(program, chunk);
                ASSERT_EQ(tips.size(), expected.size());
                for (std::size_t i = 0; i < tips.size(); ++i) ASSERT_LT(norm(tips[i] - expected[i]), 0.009);
            }
        }
    }
}

TEST(PostKrl, HasTheJointsOfTheProgram) {
    for (const Job& job : jobs()) {
        const Program program = program_of(job);
        const std::vector<ProgramPart> parts = post_program(program, job.cell, {7});
        for (const ProgramPart& part : parts) {
            for (const PostedChunk& chunk : part.chunks) {
                const ProgramOperation& operation = program.operations[chunk.operation];
                std::vector<Joints> expected = operation.entry.targets;
                if (chunk.first_run > 0) expected = {operation.runs[chunk.first_run].start_joints};
                const bool is_last = chunk.first_run + chunk.runs == operation.runs.size();
                if (is_last)
                    expected.insert(expected.end(), operation.exit.targets.begin(), operation.exit.targets.end());
                std::size_t at = 0;
                for (const ScannedLine& line : chunk_lines(part, chunk)) {
                    if (line.word != "PTP") continue;
                    ASSERT_LT(at, expected.size());
                    const Joints joints = joints_of(line);
                    for (std::size_t i = 0; i < axes_of_arm; ++i) {
                        EXPECT_NEAR(joints[i], expected[at][i], 0.00051 * degree);
                    }
                    if (program.external_axis) {
                        EXPECT_NEAR(line.values.at("E1"), operation.table_angle / degree, 0.00051);
                    }
                    ++at;
                }
                EXPECT_EQ(at, expected.size());
            }
        }
    }
}

// What the text says of one chunk: frames, the joint move before the first full pose, and that pose.
struct FirstPose {
    ScannedLine tool;
    ScannedLine base;
    ScannedLine joints;
    ScannedLine pose;
};

FirstPose first_pose(const std::vector<ScannedLine>& lines) {
    FirstPose first;
    for (const ScannedLine& line : lines) {
        if (line.word == "$TOOL") first.tool = line;
        if (line.word == "$BASE") first.base = line;
        if (line.word == "PTP") first.joints = line;
        if (line.word != "LIN") continue;
        first.pose = line;
        break;
    }
    return first;
}

// How far the flange of the joints is from that of the full pose, in mm and in mm at 1 m of lever: all from text.
double mismatch(const Job& job, const FirstPose& first, double retract) {
    const CellMachine& machine = *job.cell.machine;
    Pose base = frame_of(first.base);
    if (machine.rotary_table) {
        const double angle = first.pose.values.at("E1") * degree;
        base = inverse(machine.robot->base_in_cell) * table_in_cell(job.cell, angle) * base;
    }
    Pose tip = frame_of(first.pose);
    const Vec3 axis = machine.spindle.tool_axis == ToolAxis::x ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    tip.shift = tip.shift - retract * rotate(tip, axis);
    const Pose wanted = base * tip * inverse(frame_of(first.tool));
    const Pose held = forward(machine.robot->geometry, joints_of(first.joints));
    double largest = norm(wanted.shift - held.shift);
    for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, 1000 * norm(wanted.row[i] - held.row[i]));
    return largest;
}

TEST(PostKrl, StatesPosesThatTheJointsBeforeThemHold) {
    for (const Job& job : jobs()) {
        const Program program = program_of(job);
        for (const ProgramPart& part : post_program(program, job.cell, {7})) {
            for (const PostedChunk& chunk : part.chunks) {
                const ProgramOperation& operation = program.operations[chunk.operation];
                const double retract = chunk.first_run == 0 ? operation.entry.retract : 0;
                EXPECT_LT(mismatch(job, first_pose(chunk_lines(part, chunk)), retract), 0.2);
            }
        }
    }
}

// A sign or an order that is wrong in any frame is seen by the test above.
TEST(PostKrl, FramesOfTheTestsAreSkew) {
    for (const Job& job : {jobs()[2], jobs()[3]}) {
        const Program program = program_of(job);
        const std::vector<ProgramPart> parts = post_program(program, job.cell, {7});
        const FirstPose right = first_pose(chunk_lines(parts[0], parts[0].chunks.back()));
        const double retract = program.operations[parts[0].chunks.back().operation].entry.retract;
        const std::array<ScannedLine FirstPose::*, 3> frames{&FirstPose::tool, &FirstPose::base, &FirstPose::pose};
        for (ScannedLine FirstPose::*frame : frames) {
            for (const char* name : {"X", "Y", "Z", "A", "B", "C"}) {
                FirstPose wrong = right;
                double& value = (wrong.*frame).values[name];
                if (std::abs(value) < 0.3 || std::abs(std::abs(value) - 180) < 0.3) continue;
                value = -value;
                EXPECT_GT(mismatch(job, wrong, retract), 0.5) << (right.*frame).text << " " << name;
            }
            if ((right.*frame).values.at("A") == (right.*frame).values.at("C")) continue;
            FirstPose swapped = right;
            std::swap((swapped.*frame).values["A"], (swapped.*frame).values["C"]);
            EXPECT_GT(mismatch(job, swapped, retract), 0.5) << (right.*frame).text;
        }
    }
}

TEST(PostKrl, ToolFrameIsThatOfTheCellFile) {
    const Job& job = jobs()[2];
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    const Spindle& spindle = job.cell.machine->spindle;
    const Pose tool = frame_of(first_pose(chunk_lines(parts[0], parts[0].chunks[0])).tool);
    const Vec3 axis = rotate(spindle.spindle_in_flange, {1, 0, 0});
    const Vec3 tip = spindle.spindle_in_flange.shift + gauge_length(job.cell.machine->tools[0]) * axis;
    EXPECT_LT(norm(tool.shift - tip), 0.001);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(norm(tool.row[i] - spindle.spindle_in_flange.row[i]), 2e-6);
}

// A point of the setup is in the cell where the table's turn, the base and the coordinates put it.
TEST(PostKrl, PointsOnTheTableTurnWithIt) {
    const Job& job = jobs()[3];
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    for (const PostedChunk& chunk : parts[0].chunks) {
        const FirstPose first = first_pose(chunk_lines(parts[0], chunk));
        const Pose from_text = table_in_cell(job.cell, first.pose.values.at("E1") * degree) * frame_of(first.base);
        const Pose expected = setup_in_cell(job.cell, job.setup.spoil, job.setup.placement, chunk.orientation);
        const Vec3 point = tip_of(first.pose);
        EXPECT_LT(norm(apply(from_text, point) - apply(expected, point)), 0.01);
    }
}

TEST(PostKrl, HasOnlyTheCharactersAndFormsOfThePage) {
    for (const Job& job : jobs()) {
        for (const ProgramPart& part : post_program(program_of(job), job.cell, {7})) {
            for (const ProgramText& file : part.files) {
                ASSERT_TRUE(file.text.ends_with("\r\n"));
                EXPECT_EQ(std::count(file.text.begin(), file.text.end(), '\r'),
                          std::count(file.text.begin(), file.text.end(), '\n'));
                EXPECT_TRUE(std::all_of(file.text.begin(), file.text.end(),
                                        [](char c) { return (c >= ' ' && c <= '~') || c == '\r' || c == '\n'; }));
                for (const ScannedLine& line : scan(file.text)) {
                    for (const char* bad : {"nan", "inf", "-0.00,", "-0.00}", "-0.000,", "-0.000}", "/", "\\"}) {
                        EXPECT_EQ(line.text.find(bad), std::string::npos) << line.text;
                    }
                    EXPECT_LE(line.text.size(), 240U);
                }
                const std::string stem = file.name.substr(0, file.name.find('.'));
                EXPECT_LE(stem.size(), 24U);
            }
        }
    }
}

TEST(PostKrl, BeginsAndEndsAsThePageSays) {
    const Job& job = jobs()[1];
    const Program program = program_of(job);
    const std::vector<ProgramPart> parts = post_program(program, job.cell, {7});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].entry, "qc_7.src");
    EXPECT_EQ(parts[0].files[1].name, "qc_7.dat");
    EXPECT_EQ(parts[0].files[2].name, "qc_7_cfg.src");
    EXPECT_EQ(parts[0].files[3].name, "qc_7_cfg.dat");
    const std::vector<ScannedLine> lines = scan(parts[0].files[0].text);
    EXPECT_EQ(lines[0].text, "&ACCESS RVP");
    std::vector<std::string> moves;
    std::vector<std::string> calls;
    for (const ScannedLine& line : lines) {
        if (line.word == "PTP") moves.push_back(line.text);
        if (line.word.starts_with("qc_7_0")) calls.push_back(line.word + ".src");
    }
    EXPECT_EQ(moves.front(), "PTP {A1 0.000,A2 -90.000,A3 90.000,A4 0.000,A5 90.000,A6 0.000,E1 0.000}");
    EXPECT_EQ(moves.back(), moves.front());
    std::vector<std::string> names;
    for (const PostedChunk& chunk : parts[0].chunks) names.push_back(chunk.name);
    EXPECT_EQ(calls, names);
    EXPECT_EQ(lines[lines.size() - 3].text, "$APO.CDIS = 0.000");
    EXPECT_EQ(lines[lines.size() - 2].text, "$ADVANCE = 3");
    EXPECT_EQ(lines.back().text, "END");
}

// In every chunk the spindle has its speed before the first move.
TEST(PostKrl, StartsTheSpindleInEveryChunk) {
    const Job& job = jobs()[0];
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    for (const PostedChunk& chunk : parts[0].chunks) {
        std::vector<std::string> order;
        for (const ScannedLine& line : chunk_lines(parts[0], chunk)) {
            if (line.word.starts_with("$ANOUT") || line.word.starts_with("$OUT") || line.word == "WAIT" ||
                line.word == "PTP" || line.word == "LIN") {
                order.push_back(line.word == "WAIT" ? line.text : line.word);
            }
            if (line.word == "PTP") break;
        }
        EXPECT_EQ(order, (std::vector<std::string>{"$OUT[2]", "$ANOUT[1]", "$OUT[1]", "WAIT FOR $IN[1]", "PTP"}));
    }
}

TEST(PostKrl, CallsWhatTheCellFileNames) {
    Job job = jobs()[0];
    CellMachine& machine = *job.cell.machine;
    machine.spindle.on = Signal{SignalKind::call, "spindle_on", 1};
    machine.spindle.speed = Signal{SignalKind::call, "spindle_speed", 0.5};
    machine.spindle.at_speed = Signal{SignalKind::call, "spindle_wait", 1};
    machine.spindle.off = Signal{SignalKind::call, "spindle_off", 1};
    machine.program.tool_change_call = "take_tool";
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    const std::string& main = parts[0].files[0].text;
    EXPECT_NE(main.find("take_tool(1)\r\n"), std::string::npos);
    EXPECT_NE(main.find("take_tool(4)\r\n"), std::string::npos);
    EXPECT_NE(main.find("spindle_off( )\r\n"), std::string::npos);
    EXPECT_EQ(main.find("HALT"), std::string::npos);
    EXPECT_NE(parts[0].files[4].text.find("spindle_speed(9000.0)\r\nspindle_on( )\r\nspindle_wait( )\r\n"),
              std::string::npos);
}

// Base, tools and loads stand in the module and nowhere else.
TEST(PostKrl, FramesStandOnce) {
    for (const Job& job : jobs()) {
        for (const ProgramPart& part : post_program(program_of(job), job.cell, {7, "3f09a2"})) {
            std::set<std::string> stated;
            for (const ScannedLine& line : scan(test_krl::text_of(part, "qc_3f09a2_7_cfg.dat"))) {
                if (line.word != "DECL") continue;
                const std::size_t begin = line.text.find("qc_");
                EXPECT_TRUE(stated.insert(line.text.substr(begin, line.text.find(' ', begin) - begin)).second);
            }
            EXPECT_TRUE(stated.contains("qc_3f09a2_7_base"));
            for (const ProgramText& file : part.files) {
                if (file.name.ends_with("_cfg.dat")) continue;
                for (const ScannedLine& line : scan(file.text)) {
                    if (line.word != "$TOOL" && line.word != "$LOAD" && line.word != "$BASE") continue;
                    EXPECT_TRUE(line.values.empty()) << line.text;
                    const std::size_t begin = line.text.find("qc_");
                    ASSERT_NE(begin, std::string::npos) << line.text;
                    EXPECT_TRUE(stated.contains(line.text.substr(begin, line.text.find(')', begin) - begin)));
                }
            }
        }
    }
}

TEST(PostKrl, AsksInDialogsThatTheControllerShows) {
    Job job = jobs()[0];
    job.cell.machine->tools[0].name = std::string(50, 'n') + " \"40\" \xC3\xA4";
    job.cell.machine->tools[0].number = 65'535;
    const ProgramPart part = post_program(program_of(job), job.cell, {7}).at(0);
    std::size_t asked = 0;
    for (const ScannedLine& line : scan(part.files[0].text)) {
        if (line.word != "qc_7_ask") continue;
        ++asked;
        EXPECT_TRUE(line.text.ends_with("\")"));
        EXPECT_LE(line.text.size(), std::string("qc_7_ask(\"\")").size() + 80);
        EXPECT_EQ(std::count(line.text.begin(), line.text.end(), '"'), 2);
    }
    EXPECT_GE(asked, 2U);
    EXPECT_NE(part.files[0].text.find("mm from nose to tip, stick-out"), std::string::npos);
}

// From where a chunk has waited for them to its end.
TEST(PostKrl, WatchesWhatItHasWaitedFor) {
    Job job = jobs()[0];
    job.cell.machine->extraction->running = Signal{SignalKind::input, "9", 1};
    const ProgramPart part = post_program(program_of(job), job.cell, {7}).at(0);
    for (const PostedChunk& chunk : part.chunks) {
        std::vector<std::string> order;
        for (const ScannedLine& line : chunk_lines(part, chunk)) {
            if (line.word == "INTERRUPT" || line.word == "WAIT") order.push_back(line.text);
            if (line.word == "PTP" && (order.empty() || order.back() != "moves")) order.emplace_back("moves");
        }
        EXPECT_EQ(order,
                  (std::vector<std::string>{"INTERRUPT DECL 21 WHEN $STOPMESS == TRUE DO qc_7_stop( )",
                                            "INTERRUPT ON 21", "WAIT FOR $IN[9]", "WAIT FOR $IN[1]",
                                            "INTERRUPT DECL 22 WHEN $IN[1] == FALSE DO qc_7_fall( )", "INTERRUPT ON 22",
                                            "INTERRUPT DECL 23 WHEN $IN[9] == FALSE DO qc_7_fall( )", "INTERRUPT ON 23",
                                            "moves", "WAIT SEC 0", "INTERRUPT OFF 22", "INTERRUPT OFF 23"}));
    }
}

TEST(PostKrl, SpeedsAreThoseOfTheMoves) {
    Job job = jobs()[0];
    for (JointRange& range : job.cell.machine->robot->ranges) range.speed *= 0.05;
    job.reachability = {};
    const Program program = program_of(job);
    for (const ProgramPart& part : post_program(program, job.cell, {7})) {
        for (const PostedChunk& chunk : part.chunks) {
            const ProgramOperation& operation = program.operations[chunk.operation];
            std::vector<double> speeds;
            for (std::size_t r = chunk.first_run; r < chunk.first_run + chunk.runs; ++r) {
                speeds.push_back(operation.runs[r].link_speed);
                for (const ProgramMove& move : operation.runs[r].moves) speeds.push_back(move.speed);
            }
            double stated = 0;
            std::size_t at = 0;
            for (const ScannedLine& line : chunk_lines(part, chunk)) {
                if (line.word == "$VEL.CP") stated = 1000 * std::strtod(line.text.c_str() + 10, nullptr);
                if (line.word != "LIN" || at >= speeds.size()) continue;
                EXPECT_LE(stated, speeds[at] + 1e-9);
                EXPECT_GT(stated, speeds[at] - 0.11);
                ++at;
            }
        }
    }
}

TEST(PostKrl, GivesTheSameBytesForAnyNumberOfThreadsAndAnyLocale) {
    const Job& job = jobs()[1];
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    const ThreadLimit one(1);
    const test_krl::CommaLocale comma;
    const std::vector<ProgramPart> again = post_program(program_of(job), job.cell, {7});
    EXPECT_EQ(again, parts);
}

// A stop is not lost where a place is stated twice, and no corner is rounded where a run ends.
TEST(PostKrl, RoundsNoCornerThatIsAStop) {
    Program program = program_of(jobs()[0]);
    program.operations.resize(1);
    program.operations[0].runs.resize(1);
    std::vector<ProgramMove>& moves = program.operations[0].runs[0].moves;
    moves = {{{1, 2, 3}, MoveKind::approach, 0, 60},
             {{10, 2, 3}, MoveKind::cut, 2, 100},
             {{10.001, 2, 3}, MoveKind::cut, 0, 100},
             {{20, 2, 3}, MoveKind::cut, 2, 100},
             {{30, 2, 3}, MoveKind::cut, 2, 100}};
    const auto lines = [&] {
        std::vector<std::string> found;
        for (const ScannedLine& line : scan(post_program(program, jobs()[0].cell, {7})[0].files[4].text)) {
            if (line.word == "LIN" && line.names.size() == 3) found.push_back(line.text.substr(4));
        }
        found.resize(4);
        return found;
    };
    EXPECT_EQ(lines(), (std::vector<std::string>{"{X 1.00,Y 2.00,Z 3.00}", "{X 10.00,Y 2.00,Z 3.00}",
                                                 "{X 20.00,Y 2.00,Z 3.00} C_DIS", "{X 30.00,Y 2.00,Z 3.00}"}));
    moves[3].rounding = 0.0009;
    EXPECT_EQ(lines()[2], "{X 20.00,Y 2.00,Z 3.00}");
}

// A distance is stated where it changes, and exact corners change nothing.
TEST(PostKrl, StatesHowFarEachCornerIsRounded) {
    Program program = program_of(jobs()[0]);
    program.operations.resize(1);
    program.operations[0].runs.resize(1);
    program.operations[0].runs[0].moves = {{{10, 2, 3}, MoveKind::cut, 5, 100},   {{20, 2, 3}, MoveKind::cut, 5, 100},
                                           {{20, 9, 3}, MoveKind::cut, 0, 100},   {{30, 9, 3}, MoveKind::cut, 5, 100},
                                           {{30, 2, 3}, MoveKind::cut, 0.3, 100}, {{40, 2, 3}, MoveKind::cut, 5, 100},
                                           {{50, 2, 3}, MoveKind::cut, 0, 100}};
    std::vector<std::string> found;
    for (const ScannedLine& line : scan(post_program(program, jobs()[0].cell, {7})[0].files[4].text)) {
        if (line.text.starts_with("$APO.CDIS")) found.push_back(line.text);
        if (line.text.ends_with("C_DIS")) found.emplace_back("rounded");
    }
    EXPECT_EQ(found, (std::vector<std::string>{"$APO.CDIS = 5.000", "rounded", "rounded", "rounded",
                                               "$APO.CDIS = 0.300", "rounded", "$APO.CDIS = 5.000", "rounded"}));
}

TEST(PostKrl, RefusesMissingSignals) {
    const Job& job = jobs()[0];
    const Program program = program_of(job);
    const auto refusal = [&](const std::function<void(Spindle&)>& change) {
        Cell lacking = job.cell;
        change(lacking.machine->spindle);
        try {
            post_program(program, lacking, {7});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refusal([](Spindle& s) { s.on.reset(); }).find("spindle.on"), std::string::npos);
    EXPECT_NE(refusal([](Spindle& s) { s.at_speed.reset(); }).find("spindle.at_speed"), std::string::npos);
    EXPECT_EQ(refusal([](Spindle& s) { s.off.reset(); }), "");
    EXPECT_NE(refusal([](Spindle& s) { s.speed->scale = 1; }).find("speed of the spindle"), std::string::npos);
}

TEST(PostKrl, RefusesValuesThatNoProgramMayHave) {
    const Job& job = jobs()[0];
    const Program good = program_of(job);
    Program bad = good;
    bad.operations[1].runs[0].moves[2].tip.z = std::nan("");
    EXPECT_THROW(post_program(bad, job.cell, {7}), InputError);
    bad = good;
    bad.operations[1].runs[0].moves[2].speed = 0.01;
    EXPECT_THROW(post_program(bad, job.cell, {7}), InputError);
    bad = good;
    bad.operations[0].runs[0].start.x = 5000;
    EXPECT_THROW(post_program(bad, job.cell, {7}), InputError);
}

TEST(PostKrl, ForAnotherNumberOfThePieceOtherNamesAreAllThatChanges) {
    for (const Job& job : jobs()) {
        const Program program = program_of(job);
        const std::vector<ProgramPart> first = post_program(program, job.cell, {7});
        const ProgramName other{8};
        const std::vector<ProgramPart> second = post_program(program, job.cell, other);
        ASSERT_EQ(first.size(), second.size());
        for (std::size_t p = 0; p < first.size(); ++p) {
            EXPECT_EQ(renamed_file(first[p].entry, {7}, other), second[p].entry);
            ASSERT_EQ(first[p].files.size(), second[p].files.size());
            for (std::size_t i = 0; i < first[p].files.size(); ++i) {
                EXPECT_NE(first[p].files[i].text, second[p].files[i].text);
                EXPECT_EQ(renamed_file(first[p].files[i].name, {7}, other), second[p].files[i].name);
                EXPECT_EQ(renamed_text(first[p].files[i].text, {7}, other), second[p].files[i].text);
            }
        }
    }
    EXPECT_EQ(renamed_file("qc_71.src", {7}, {8}), "qc_71.src");
    EXPECT_EQ(renamed_text("qc_71_001( )\r\nqc_7x( )\r\n;qc_7", {7}, {8}), "qc_71_001( )\r\nqc_7x( )\r\n;qc_7");
    EXPECT_EQ(renamed_text("qc_7_ask(\"Put tool 1 (qc_7) in\")\r\n;program qc_7", {7}, {8}),
              "qc_8_ask(\"Put tool 1 (qc_7) in\")\r\n;program qc_8");
}

}  // namespace
}  // namespace qchopper
