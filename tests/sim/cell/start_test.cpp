// Start happens once, and QUERY tells of it.

#include "sim/cell/machine.h"

#include <gtest/gtest.h>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_digest;
using bench::good_ticket;
using bench::job_a;
using bench::job_b;
using bench::owner;

constexpr std::uint32_t other_owner = 0x33333333;

// After the end of job_a, with the lease: to Idle without a job.
void clear_and_reset(Bench& bench) {
    ASSERT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::reset), AckResult::ok);
    bench.pass(300);
}

TEST(Start, IsDoneOnceHoweverOftenItIsSent) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    ASSERT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::ok);
    // The very same frame again: the stored acknowledgement.
    Command again{
        bench.cell.memory.epoch_held, bench.seq, CellCommand::start, job_a, token, 0, 0, good_digest(), owner};
    const std::uint16_t bad = bench.cell.bad_frames;
    for (int n = 0; n < 3; ++n) receive_command(bench.cell, encode(again), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    EXPECT_EQ(bench.cell.bad_frames, bad);
    // The same number with other contents, and a lower number, are not even acknowledged.
    again.token ^= 1;
    receive_command(bench.cell, encode(again), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.bad_reason, AckResult::stale_seq);
    // A new command for the running job, and for the finished one.
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::already);
    bench.pass(102000);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::already_finished);
    clear_and_reset(bench);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::already_finished);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Start, IsSavedBeforeAnythingMoves) {
    Bench bench;
    bench.to_prepared();
    bench.can_save = false;
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::store_io);
    EXPECT_EQ(bench.cell.state, PackState::idle);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    bench.can_save = true;
    bench.saved.clear();
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::ok);
    ASSERT_FALSE(bench.saved.empty());
    EXPECT_EQ(bench.saved.front().jobs.at(job_a).state, JobState::running);
    EXPECT_EQ(bench.saved.front().starts_total, 1U);
}

TEST(Start, NeedsTheTokenAndAWrongOneChangesNothing) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token + 1), AckResult::token_bad);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 0), AckResult::token_bad);
    EXPECT_EQ(bench.send(CellCommand::start, job_b, token), AckResult::wrong_job);
    EXPECT_EQ(bench.cell.job.token, token);
    for (int s = 0; s < 119; ++s) {
        bench.heartbeat();
        bench.pass(1000);
    }
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
    bench.heartbeat();
    bench.pass(1500);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::token_expired);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Start, OfAnotherFileIsRefused) {
    Bench bench;
    bench.to_prepared();
    Command command{bench.cell.memory.epoch_held, 0, CellCommand::start, job_a, bench.cell.job.token, 0, 0, {}, owner};
    EXPECT_EQ(bench.send(command), AckResult::hash_mismatch);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Query, AnswersAnyClientWithTheRecordOfTheJob) {
    Bench bench;
    bench.to_running();
    const auto ask = [&](const Uuid& id) {
        Command query{0, 0, CellCommand::query, id, 0, 0, 0, {}, other_owner};
        bench.send(query);
        EXPECT_EQ(bench.cell.answer.query_owner, other_owner);
        EXPECT_EQ(bench.cell.answer.query_seq, bench.seq);
        EXPECT_EQ(bench.cell.answer.job_id, id);
        return bench.cell.answer;
    };
    EXPECT_EQ(ask(job_a).state, JobState::running);
    EXPECT_EQ(ask(job_a).starts, 1U);
    EXPECT_EQ(ask(job_b).state, JobState::none);
    EXPECT_EQ(bench.cell.ack.result, AckResult::unknown_job);
    bench.pass(102000);
    EXPECT_EQ(ask(job_a).result, JobResult::complete);
    EXPECT_EQ(ask(job_a).end_time_ms - ask(job_a).start_time_ms, 100400U);
    EXPECT_EQ(ask(job_a).file_sha256, good_digest());
}

}  // namespace
}  // namespace qchopper
