#include "sim/cell/program_run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "devices/wire/program_block.h"
#include "sim/cell/panel.h"
#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::job_a;

// A main program whose line 20 brings the tip to chunk 1, two lines of which the first has three steps, a tool change,
// a line of chunk 2, and line 30 of the main program: 40 s in all, as the ticket says 100.
JobRun short_run() {
    JobRun run;
    run.steps = {{2, program_block(0, 20), 8, {10, 0, 50}},    {3, program_block(1, 61), 8, {20, 0, 50}},
                 {4, program_block(1, 61), 8, {30, 0, 50}},    {6, program_block(1, 61), 8, {40, 0, 50}},
                 {16, program_block(1, 62), 8, {40, 100, 50}}, {26, program_block(1, 62), 4, {40, 100, 50}},
                 {30, program_block(2, 61), 4, {0, 0, 5}},     {40, program_block(0, 30), 4, {10, 0, 50}}};
    run.waits = {{2, 1, program_block(1, 40)}, {26, 1, program_block(2, 40)}};
    run.seconds = 40;
    return run;
}

ReceivedProgram received() {
    return {std::make_shared<const JobRun>(short_run()), {}, 0};
}

// In Execute, as many seconds of the job after its beginning.
void to_second(Bench& bench, double seconds) {
    bench.program = received();
    bench.to_running();
    bench.pass(bench.cell.limits.acting_ms);
    ASSERT_EQ(bench.cell.state, PackState::execute);
    bench.pass(static_cast<std::int64_t>(1000 * seconds));
}

TEST(ProgramRun, ABlockNumberNamesChunkAndLine) {
    EXPECT_EQ(program_block(3, 412), 3000412U);
    EXPECT_EQ(chunk_of_block(3000412), 3U);
    EXPECT_EQ(line_of_block(3000412), 412U);
    EXPECT_EQ(program_block(0, 57), 57U);
    EXPECT_EQ(program_block(1, 2'000'000), 1'999'999U) << "a longer file stays in its chunk";
    EXPECT_EQ(program_block(100'000, 0xFFFFFFFF), 4'293'999'999U);
}

TEST(ProgramRun, TheTipGoesStraightFromEndToEnd) {
    const JobRun run = short_run();
    EXPECT_EQ(place_at(run, 0).tip, (Vec3{10, 0, 50})) << "where it was before the first step is not known";
    const RunPlace within = place_at(run, 11);
    EXPECT_EQ(within.block, program_block(1, 62));
    EXPECT_EQ(within.tool, 8);
    EXPECT_NEAR(norm(within.tip - Vec3{40, 50, 50}), 0, 1e-9);
    EXPECT_EQ(place_at(run, 20).tool, 4);
    EXPECT_EQ(place_at(run, 6).block, program_block(1, 62)) << "the next line begins";
    EXPECT_EQ(place_at(run, 1e9).block, program_block(0, 30));
    EXPECT_EQ(place_at(run, 1e9).tip, (Vec3{10, 0, 50}));
}

TEST(ProgramRun, ALineEndsWithItsLastStep) {
    const JobRun run = short_run();
    EXPECT_EQ(line_end(run, 0), 0) << "nothing has begun";
    EXPECT_EQ(line_end(run, 2), 2);
    EXPECT_EQ(line_end(run, 2.5), 6);
    EXPECT_EQ(line_end(run, 3), 6) << "between two steps of a line";
    EXPECT_EQ(line_end(run, 10), 26) << "with the tool change";
    EXPECT_EQ(line_end(run, 40), 40);
}

TEST(ProgramRun, ABlockBeginsOnceItsFileComesToIt) {
    const JobRun run = short_run();
    EXPECT_EQ(begin_of_block(run, program_block(1, 62), 0), 6);
    EXPECT_EQ(begin_of_block(run, program_block(1, 10), 0), 2) << "the next line that moves";
    EXPECT_EQ(begin_of_block(run, program_block(0, 25), 0), 30) << "of the main program";
    EXPECT_EQ(begin_of_block(run, program_block(1, 63), 0), std::nullopt);
    EXPECT_EQ(begin_of_block(run, program_block(1, 62), 7), 16) << "the tool change is in that line";
    EXPECT_EQ(begin_of_block(run, program_block(1, 62), 17), std::nullopt);
}

TEST(ProgramRun, StatusIsThatOfTheProgram) {
    Bench bench;
    to_second(bench, 11);
    const Status status = bench.status();
    EXPECT_EQ(status.block_no, program_block(1, 62));
    EXPECT_EQ(status.tool_no, 8);
    EXPECT_EQ(status.tip, (std::array<std::int32_t, 3>{4000, 5000, 5000}));
    EXPECT_EQ(status.progress, 2750);
    EXPECT_EQ(status.elapsed_s, 11U);
    EXPECT_EQ(status.remaining_s, 29U) << "of the program, not of the ticket's estimate";
    bench.pass(20000);
    EXPECT_EQ(bench.status().block_no, program_block(0, 30));
    bench.pass(10000);
    EXPECT_EQ(bench.cell.job.result, JobResult::complete);
    EXPECT_EQ(bench.status().progress, 10000);
    EXPECT_EQ(bench.cell.memory.jobs.at(job_a).last_block, program_block(0, 30));
}

TEST(ProgramRun, AJobWithoutAProgramGoesOnByTheClock) {
    Bench bench;
    bench.to_running();
    bench.pass(bench.cell.limits.acting_ms + 11000);
    EXPECT_EQ(bench.status().block_no, 110U);
    EXPECT_EQ(bench.status().remaining_s, 89U);
}

TEST(ProgramRun, HoldStopsAtTheEndOfTheLineAndUnholdGoesOnThere) {
    Bench bench;
    to_second(bench, 2.5);
    ASSERT_EQ(bench.send(CellCommand::hold, job_a), AckResult::ok);
    bench.pass(3000);
    EXPECT_EQ(bench.cell.state, PackState::holding) << "the line takes longer than the machine needs to stop";
    EXPECT_EQ(bench.status().elapsed_s, 5U) << "it goes on";
    bench.pass(600);
    ASSERT_EQ(bench.cell.state, PackState::held);
    EXPECT_EQ(bench.cell.job.run_s, 6);
    bench.pass(60000);
    EXPECT_EQ(bench.status().tip, (std::array<std::int32_t, 3>{4000, 0, 5000})) << "it stands at the end of line 61";
    bench.heartbeat();
    ASSERT_EQ(bench.claim(), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::unhold, job_a), AckResult::pending);
    bench.pass(10 + bench.cell.limits.acting_ms + 5000);
    ASSERT_EQ(bench.cell.state, PackState::execute);
    EXPECT_NEAR(bench.status().tip[1], 5000, 20) << "half of line 62 is done";
}

TEST(ProgramRun, HoldBetweenTwoLinesStopsAtOnce) {
    Bench bench;
    to_second(bench, 6);
    ASSERT_EQ(bench.send(CellCommand::hold, job_a), AckResult::ok);
    bench.pass(bench.cell.limits.acting_ms);
    EXPECT_EQ(bench.cell.state, PackState::held);
    EXPECT_EQ(bench.cell.job.run_s, 6);
}

TEST(ProgramRun, AFaultComesAtItsLine) {
    Bench bench;
    arm(bench.cell, {Fault::tool_fault, program_block(2, 61)}, bench.now);
    to_second(bench, 25.9);
    EXPECT_EQ(bench.cell.state, PackState::execute);
    bench.pass(200);
    EXPECT_EQ(bench.cell.job.result, JobResult::tool);
    EXPECT_EQ(bench.status().alarm_block, program_block(2, 61));
    EXPECT_EQ(bench.cell.memory.jobs.at(job_a).last_block, program_block(2, 61));
}

TEST(ProgramRun, ASpindleWithoutSpeedStopsTheProgramInItsLine) {
    Bench bench;
    arm(bench.cell, {Fault::spindle_loses_speed, program_block(1, 62)}, bench.now);
    to_second(bench, 10);
    EXPECT_EQ(bench.cell.state, PackState::aborted);
    EXPECT_EQ(bench.cell.job.result, JobResult::tool);
    EXPECT_EQ(bench.status().alarm_text, "spindle speed");
    EXPECT_EQ(bench.status().block_no, program_block(1, 62));
    EXPECT_EQ(bench.status().elapsed_s, 6U) << "it goes no further";
}

TEST(ProgramRun, AnInputThatFallsStopsTheProgramWhereItIsWaitedFor) {
    for (const std::int64_t input : {0, 1, 2}) {
        Bench bench;
        to_second(bench, 10);
        arm(bench.cell, {Fault::signal_falls, input}, bench.now);
        bench.pass(31000);
        if (input == 2) {
            EXPECT_EQ(bench.cell.job.result, JobResult::complete) << "nothing waits for it";
            continue;
        }
        EXPECT_EQ(bench.cell.job.result, JobResult::aborted);
        EXPECT_EQ(bench.status().alarm_text, input == 1 ? "input 1 missing" : "input missing");
        EXPECT_EQ(bench.status().elapsed_s, 26U) << "the first one is passed";
    }
}

TEST(ProgramRun, APowerCutKeepsTheLine) {
    Bench bench;
    to_second(bench, 11);
    bench.restart();
    const JobRecord& record = bench.cell.memory.jobs.at(job_a);
    EXPECT_EQ(record.result, JobResult::power_loss);
    EXPECT_EQ(record.last_block, program_block(1, 62));
    EXPECT_NEAR(bench.cell.surroundings.carved.run_s, 11, 0.02);
    bench.pass(5000);
    bench.restart();
    EXPECT_NEAR(bench.cell.surroundings.carved.run_s, 11, 0.02) << "nothing moved since";
}

TEST(ProgramRun, AProgramThatCannotBeReadIsRefusedBeforeSomebodyIsAsked) {
    Bench bench;
    std::vector<std::string> lines;
    bench.hooks.log = [&](const std::string& line) { lines.push_back(line); };
    bench.program = {nullptr, "qc_7_003.src, line 12: GOTO is not known", 12};
    bench.to_verified();
    const std::string told = "the program of piece-1.qjob cannot be executed: qc_7_003.src, line 12: GOTO is not known";
    EXPECT_NE(std::ranges::find(lines, told), lines.end());
    const CellMemory before = bench.cell.memory;
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::program_unreadable);
    EXPECT_EQ(bench.cell.ack.detail, 12U);
    EXPECT_FALSE(bench.cell.pending);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.cell.state, PackState::idle);
    EXPECT_EQ(bench.cell.memory, before) << "nothing is lost";
    ASSERT_EQ(bench.send(CellCommand::rehearse, job_a), AckResult::pending);
    bench.pass(6 * bench.cell.limits.acting_ms);
    EXPECT_EQ(bench.cell.ack.result, AckResult::program_unreadable);
    EXPECT_EQ(bench.cell.job.result, JobResult::rehearsal_failed);
    EXPECT_EQ(bench.send(CellCommand::cancel, job_a), AckResult::ok) << "the cell takes another job";
}

}  // namespace
}  // namespace qchopper
