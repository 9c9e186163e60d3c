// How the machine runs a job, what STATUS shows, and what power on does.

#include "sim/cell/machine.h"

#include <gtest/gtest.h>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_digest;
using bench::job_a;
using bench::job_b;
using bench::owner;
using bench::secret;

constexpr std::uint32_t other_owner = 0x33333333;

TEST(Machine, AJobRunsForItsTimeAndEnds) {
    Bench bench;
    bench.to_running();
    EXPECT_EQ(bench.status().state, PackState::starting);
    bench.pass(50000);
    const Status half = bench.status();
    EXPECT_EQ(half.state, PackState::execute);
    EXPECT_EQ(half.job_state, JobState::running);
    EXPECT_NEAR(half.progress, 4980, 2);
    EXPECT_EQ(half.elapsed_s + half.remaining_s, 100U);
    EXPECT_EQ(half.tool_no, 3);
    bench.pass(51000);
    const Status end = bench.status();
    EXPECT_EQ(end.state, PackState::complete);
    EXPECT_EQ(end.job_state, JobState::ended);
    EXPECT_EQ(end.job_result, JobResult::complete);
    EXPECT_EQ(end.progress, 10000);
    EXPECT_EQ(end.starts_total, 1U);
    EXPECT_TRUE(end.has(flag::result_waiting));
}

TEST(Machine, TheSpeedOfTheCellShortensTheJobOnly) {
    CellLimits limits;
    limits.speed = 50;
    Bench bench(limits);
    bench.to_running();
    bench.pass(2200);
    EXPECT_EQ(bench.cell.state, PackState::completing);
}

TEST(Machine, TimeInOneStepIsTheSameAsTimeInMany) {
    Bench fine;
    Bench coarse;
    fine.to_running();
    coarse.to_running();
    fine.pass(200000);
    coarse.now.steady_ms += 200000;
    coarse.now.unix_ms += 200000;
    pass_time(coarse.cell, coarse.now, coarse.hooks);
    EXPECT_EQ(fine.cell.state, coarse.cell.state);
    EXPECT_EQ(fine.cell.state_since_ms, coarse.cell.state_since_ms);
    EXPECT_EQ(fine.cell.job.state, JobState::ended);
}

TEST(Machine, HoldStopsTheClockOfTheJob) {
    Bench bench;
    bench.to_running();
    bench.pass(20200);
    ASSERT_EQ(bench.send(CellCommand::hold, job_a), AckResult::ok);
    const std::uint16_t progress = bench.status().progress;
    bench.pass(30000);
    EXPECT_EQ(bench.status().progress, progress);
    EXPECT_EQ(bench.status().job_state, JobState::interrupted);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::unhold, job_a), AckResult::pending);
    bench.pass(10);
    ASSERT_EQ(bench.cell.ack.result, AckResult::ok);
    bench.pass(80000);
    EXPECT_LT(bench.status().progress, 10000);
    bench.pass(1000);
    EXPECT_EQ(bench.status().job_result, JobResult::complete);
}

TEST(Machine, StopAndAbortEndTheJobForGood) {
    for (const CellCommand command : {CellCommand::stop, CellCommand::abort, CellCommand::complete}) {
        Bench bench;
        bench.to_running();
        bench.pass(1000);
        ASSERT_EQ(bench.send(command, job_a), AckResult::ok);
        bench.pass(500);
        const bool is_abort = command == CellCommand::abort;
        EXPECT_EQ(bench.cell.job.result, is_abort ? JobResult::aborted : JobResult::stopped) << name(command);
        EXPECT_EQ(bench.cell.job.state, command == CellCommand::complete ? JobState::ended : JobState::aborted);
        EXPECT_EQ(bench.cell.memory.jobs.at(job_a).state, bench.cell.job.state);
        EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::already_finished);
    }
}

TEST(Machine, ALateStopForAnotherJobDoesNotStopThisOne) {
    Bench bench;
    bench.to_running();
    EXPECT_EQ(bench.send(CellCommand::stop, job_b), AckResult::wrong_job);
    EXPECT_EQ(bench.send(CellCommand::abort, job_b), AckResult::wrong_job);
    EXPECT_EQ(bench.cell.state, PackState::starting);
    EXPECT_EQ(bench.send(CellCommand::abort, bench::any_job), AckResult::ok);
    EXPECT_EQ(bench.cell.state, PackState::aborting);
}

TEST(Machine, StopHoldAndAbortNeedNoLease) {
    for (const CellCommand command : {CellCommand::stop, CellCommand::hold, CellCommand::abort}) {
        Bench bench;
        bench.to_running();
        bench.pass(1000);
        Command stranger{0, 0, command, job_a, 0, 0, 0, {}, other_owner};
        EXPECT_EQ(bench.send(stranger), AckResult::ok) << name(command);
    }
}

TEST(Boot, ARunningJobIsAbortedForGoodAndNothingMovesByItself) {
    CellMemory memory;
    {
        Bench bench;
        bench.to_running();
        memory = bench.saved.back();
    }
    Bench bench({}, memory);
    EXPECT_EQ(bench.status().boot_count, 2U);
    EXPECT_EQ(bench.cell.state, PackState::aborted);
    EXPECT_EQ(bench.cell.memory.jobs.at(job_a).result, JobResult::power_loss);
    EXPECT_EQ(bench.status().starts_total, 1U);
    EXPECT_EQ(bench.status().epoch_held, memory.epoch_held);
    bench.pass(100000);
    EXPECT_EQ(bench.cell.state, PackState::aborted);
    EXPECT_EQ(bench.cell.job.state, JobState::none);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::reset), AckResult::wrong_state);
    EXPECT_EQ(bench.send(CellCommand::clear), AckResult::pending);
    bench.pass(300);
    EXPECT_EQ(bench.cell.state, PackState::stopped);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::already_finished);
}

TEST(Boot, AnEpochFromBeforeIsStaleAfterwards) {
    CellMemory memory;
    memory.epoch_held = 9;
    Bench bench({}, memory);
    Command claim{9, 0, CellCommand::claim, {}, 0, 0, secret, {}, owner};
    EXPECT_EQ(bench.send(claim), AckResult::stale_epoch);
    claim.epoch = 10;
    EXPECT_EQ(bench.send(claim), AckResult::ok);
}

TEST(Status, ShowsInEveryStateThatTheCellIsSimulated) {
    Bench bench;
    EXPECT_TRUE(bench.status().has(flag::simulated));
    bench.to_running();
    EXPECT_TRUE(bench.status().has(flag::simulated));
    EXPECT_TRUE(bench.status().has(flag::warning));  // unsigned
}

TEST(Status, ManySendersDoNotRemoveTheAcknowledgementOfTheOwner) {
    Bench bench;
    bench.to_prepared();
    Command start{
        bench.cell.memory.epoch_held, 0, CellCommand::start, job_a, bench.cell.job.token, 0, 0, good_digest(), owner};
    ASSERT_EQ(bench.send(start), AckResult::ok);
    start.seq = bench.seq;
    for (std::uint32_t n = 0; n < 2000; ++n) {
        Command query{0, 0, CellCommand::query, job_a, 0, 0, 0, {}, 0x44440000 + n};
        bench.send(query);
    }
    EXPECT_LE(bench.cell.senders.size(), 256U);
    receive_command(bench.cell, encode(start), bench.now, bench.hooks);
    EXPECT_EQ(bench.status().ack_owner, owner);
    EXPECT_EQ(bench.status().ack_result, AckResult::ok);
}

}  // namespace
}  // namespace qchopper
