#include "sim/machine.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "devices/register_writer.h"
#include "tests/sim/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_digest;
using bench::good_ticket;
using bench::job_a;
using bench::job_b;
using bench::owner;
using bench::secret;

constexpr std::uint32_t other_owner = 0x33333333;

using Change = std::function<void(WireTicket&)>;

WireTicket changed_ticket(const Change& change) {
    WireTicket ticket = good_ticket();
    change(ticket);
    return ticket;
}

// After the end of job_a, with the lease: to Idle without a job.
void clear_and_reset(Bench& bench) {
    ASSERT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::reset), AckResult::ok);
    bench.pass(300);
}

// PREPARE of a verified job with such a ticket: the result and its detail. PENDING if and only if somebody is asked.
std::pair<AckResult, std::uint32_t> prepare(const CellLimits& limits, const Change& change) {
    Bench bench(limits);
    bench.to_verified(changed_ticket(change));
    const AckResult result = bench.send(CellCommand::prepare, job_a);
    EXPECT_EQ(bench.cell.pending.has_value(), result == AckResult::pending);
    return {result, bench.cell.ack.detail};
}

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
        bench.beat();
        bench.pass(1000);
    }
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
    bench.beat();
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

TEST(Fence, AClaimWithAHigherEpochMakesEveryOlderCommandStale) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    const std::uint32_t old_epoch = bench.cell.memory.epoch_held;
    ASSERT_EQ(bench.claim(), AckResult::ok);  // the same owner with the same secret
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    Command late{old_epoch, 0, CellCommand::start, job_a, token, 0, 0, good_digest(), owner};
    EXPECT_EQ(bench.send(late), AckResult::stale_epoch);
    late.epoch = bench.cell.memory.epoch_held;
    EXPECT_EQ(bench.send(late), AckResult::token_bad);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Fence, ASecondDispatcherWithTheSameEpochNumberIsNotTheOwner) {
    Bench bench;
    bench.to_idle();
    bench.write_ticket(good_ticket());
    Command command{bench.cell.memory.epoch_held, 0, CellCommand::store, job_a, 0, 0, 0, good_digest(), other_owner};
    EXPECT_EQ(bench.send(command), AckResult::not_owner);
    EXPECT_EQ(bench.claim(other_owner, 5), AckResult::lease_busy);
    EXPECT_EQ(bench.cell.ack.detail, owner);
    EXPECT_EQ(bench.claim(owner, secret + 1), AckResult::lease_busy);  // the same number, but not the same one
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ok);
}

TEST(Fence, ARefusedClaimChangesNothing) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t epoch = bench.cell.memory.epoch_held;
    EXPECT_EQ(bench.claim(other_owner, 5), AckResult::lease_busy);
    Command old{epoch, 0, CellCommand::claim, {}, 0, 0, secret, {}, owner};
    EXPECT_EQ(bench.send(old), AckResult::stale_epoch);
    EXPECT_EQ(bench.cell.memory.epoch_held, epoch);
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
}

TEST(Fence, TheCodeOfThePanelTakesTheCellOver) {
    CellLimits limits;
    limits.takeover_code = 4711;
    Bench bench(limits);
    bench.to_idle();
    EXPECT_EQ(bench.claim(other_owner, 5, 4712), AckResult::lease_busy);
    EXPECT_EQ(bench.claim(other_owner, 5, 4711), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::reset), AckResult::not_owner);
}

TEST(Lease, RunsOutWithoutHeartbeatsAndLastsWithThem) {
    Bench bench;
    bench.to_prepared();
    for (int n = 0; n < 40; ++n) {
        bench.beat();
        bench.pass(500);
    }
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
    EXPECT_FALSE(bench.status().has(flag::watchdog_expired));
    bench.pass(2500);
    EXPECT_TRUE(bench.status().has(flag::watchdog_expired));
    EXPECT_TRUE(bench.status().has(flag::lease_held));
    bench.pass(2600);
    EXPECT_FALSE(bench.status().has(flag::lease_held));
    EXPECT_EQ(bench.status().owner_held, 0U);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.status().token, 0U);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::not_owner);
}

TEST(Lease, AHeartbeatThatDoesNotChangeOrIsNotOursDoesNotCount) {
    Bench bench;
    bench.to_idle();
    bench.beat();
    const std::uint32_t epoch = bench.cell.memory.epoch_held;
    for (int n = 0; n < 60; ++n) {
        receive_heartbeat(bench.cell, encode(Heartbeat{epoch, owner, bench.counter}), bench.now);
        receive_heartbeat(bench.cell, encode(Heartbeat{epoch + 1, owner, static_cast<std::uint16_t>(n)}), bench.now);
        receive_heartbeat(bench.cell, encode(Heartbeat{epoch, other_owner, static_cast<std::uint16_t>(n)}), bench.now);
        receive_heartbeat(bench.cell, Registers(5, 0), bench.now);
        bench.pass(100);
    }
    EXPECT_FALSE(bench.cell.lease.has_value());
}

TEST(Lease, TheHeartbeatMayWrap) {
    Bench bench;
    bench.to_idle();
    bench.counter = 65530;
    for (int n = 0; n < 20; ++n) {
        bench.beat();
        bench.pass(1000);
    }
    EXPECT_TRUE(bench.cell.lease.has_value());
}

TEST(Lease, WithoutHeartbeatsTheJobIsHeldOnlyIfTheTicketOrdersIt) {
    for (const LinkLoss policy : {LinkLoss::go_on, LinkLoss::hold}) {
        Bench bench;
        WireTicket ticket = good_ticket();
        ticket.on_link_loss = policy;
        bench.to_running(ticket);
        bench.pass(4000);
        EXPECT_EQ(bench.cell.state, policy == LinkLoss::hold ? PackState::held : PackState::execute);
    }
}

TEST(Frames, WhatCannotBeTrustedHasNoEffectAndIsCounted) {
    Bench bench;
    bench.to_prepared();
    const Command start{bench.cell.memory.epoch_held,
                        bench.seq + 1,
                        CellCommand::start,
                        job_a,
                        bench.cell.job.token,
                        0,
                        0,
                        good_digest(),
                        owner};
    const Registers good = encode(start);
    const Acknowledgement before = bench.cell.ack;
    const auto spoil = [&](std::size_t at) {
        Registers registers = good;
        registers[at] ^= 0x0100;
        receive_command(bench.cell, registers, bench.now, bench.hooks);
        return bench.cell.bad_reason;
    };
    EXPECT_EQ(spoil(0), AckResult::bad_magic);
    EXPECT_EQ(spoil(1), AckResult::bad_version);
    EXPECT_EQ(spoil(16), AckResult::bad_crc);
    EXPECT_EQ(bench.cell.bad_frames, 3);
    EXPECT_EQ(bench.cell.ack.seq, before.seq);
    receive_command(bench.cell, Registers(60, 0), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.bad_frames, 3);  // zeros are inert
    // The right frame still works.
    receive_command(bench.cell, good, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Frames, AnAcknowledgementThatWasOvertakenIsRepeatedOnRequest) {
    Bench bench;
    bench.to_prepared();
    Command start{
        bench.cell.memory.epoch_held, 0, CellCommand::start, job_a, bench.cell.job.token, 0, 0, good_digest(), owner};
    ASSERT_EQ(bench.send(start), AckResult::ok);
    start.seq = bench.seq;
    Command query{0, 0, CellCommand::query, job_a, 0, 0, 0, {}, other_owner};
    ASSERT_EQ(bench.send(query), AckResult::ok);
    EXPECT_EQ(bench.status().ack_owner, other_owner);
    receive_command(bench.cell, encode(start), bench.now, bench.hooks);
    EXPECT_EQ(bench.status().ack_owner, owner);
    EXPECT_EQ(bench.status().ack_result, AckResult::ok);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Frames, UnknownCommandsAndAnOwnerOfZeroAreRefused) {
    Bench bench;
    bench.to_idle();
    EXPECT_EQ(bench.send(static_cast<CellCommand>(77)), AckResult::unknown_cmd);
    EXPECT_EQ(bench.send(CellCommand::none), AckResult::unknown_cmd);
    Command nobody{0, 0, CellCommand::query, job_a, 0, 0, 0, {}, 0};
    EXPECT_EQ(bench.send(nobody), AckResult::not_owner);
}

TEST(Store, TheSameTicketAgainIsAlreadyThereAndAnotherOneIsNot) {
    Bench bench;
    bench.to_stored();
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::already);
    WireTicket other = good_ticket();
    other.file_size = 2000;
    bench.write_ticket(other);
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::job_id_reused);
    bench.write_ticket(good_ticket(job_b));
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::busy_other_job);
    ASSERT_EQ(bench.send(CellCommand::cancel, job_a), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::ok);
}

TEST(Store, AnIdThatWasStartedOrCancelledIsNeverTakenAgain) {
    Bench bench;
    bench.to_running();
    bench.pass(102000);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    clear_and_reset(bench);
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::job_id_reused);
    bench.write_ticket(good_ticket(job_b));
    ASSERT_EQ(bench.send(CellCommand::store, job_b), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::cancel, job_b), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::cancel, job_b), AckResult::already);
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::cancelled);
}

TEST(Store, WithoutATicketOrWithADamagedOneNothingIsStored) {
    Bench bench;
    bench.to_idle();
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::no_ticket);
    bench.write_ticket(good_ticket());
    bench.cell.ticket_draft[30] ^= 1;
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ticket_crc);
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::ticket_field);
    EXPECT_EQ(bench.cell.ack.detail, 101U);
    EXPECT_EQ(bench.cell.job.state, JobState::none);
}

TEST(Store, EveryFieldThatIsWrongIsNamedByItsAddress) {
    const auto refused_at = [](const Change& change) -> std::uint32_t {
        Bench bench;
        bench.to_idle();
        const WireTicket ticket = changed_ticket(change);
        bench.write_ticket(ticket);
        EXPECT_EQ(bench.send(CellCommand::store, ticket.job_id), AckResult::ticket_field);
        return bench.cell.ack.detail;
    };
    EXPECT_EQ(refused_at([](WireTicket& t) { t.ticket_version = 2; }), 100U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.job_id = {}; }), 101U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.file_size = 0; }), 125U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.transfer = static_cast<Transfer>(3); }), 127U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.file_name = "../etc"; }), 128U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.unit = 2; }), 144U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.box_min[1] = t.box_max[1]; }), 147U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.stock[2] = 0; }), 161U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.material = 5; }), 163U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.tool_diameter_um = 0; }), 165U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.piece_no = 2; }), 173U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.on_link_loss = static_cast<LinkLoss>(2); }), 187U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.requirements = 2; }), 188U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.cell_id = 7; }), 193U);
    EXPECT_EQ(refused_at([](WireTicket& t) { t.made_for = 0; }), 194U);
}

TEST(Store, ANameWithSomethingHiddenBehindItsEndIsRefused) {
    const Field& name = *field_named(ticket_block, "FILE_NAME");
    for (const std::size_t behind : {7U, 15U}) {  // "piece-1.qjob" fills six registers
        Bench bench;
        bench.to_idle();
        Registers block = encode(good_ticket());
        block[name.address - ticket_block.base + behind] = 0x4142;
        const std::uint32_t crc = crc32_of_registers(std::span(block).first(98));
        block[98] = static_cast<std::uint16_t>(crc >> 16U);
        block[99] = static_cast<std::uint16_t>(crc & 0xFFFFU);
        ASSERT_TRUE(decode_ticket(block).is_ok());
        ASSERT_EQ(decode_ticket(block).value.file_name, "piece-1.qjob");
        bench.cell.ticket_draft = block;
        EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ticket_field) << behind;
        EXPECT_EQ(bench.cell.ack.detail, 128U);
    }
}

TEST(Store, RemovesOldCopiesBeforeItRefusesAJobForLackOfSpace) {
    Bench bench;
    std::vector<std::uint64_t> asked;
    std::uint32_t free_kib = 0;
    bench.hooks.remove_old_copies = [&](const CellMemory&, std::uint64_t bytes) {
        asked.push_back(bytes);
        return free_kib;
    };
    bench.to_idle();
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::store_full);
    free_kib = 2;
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ok);
    EXPECT_EQ(asked, (std::vector<std::uint64_t>{2024, 2024})) << "a whole KiB more than the file";
}

TEST(Fence, AnEpochFarAheadIsRefusedAndChangesNothing) {
    const auto claim = [](Bench& bench, std::uint32_t epoch) {
        Command command;
        command.command = CellCommand::claim;
        command.epoch = epoch;
        command.owner = owner;
        command.arg1 = secret;
        return bench.send(command);
    };
    CellMemory memory;
    memory.epoch_held = 1000;
    for (const std::uint32_t epoch : {1000U + (1U << 20) + 1, 0x80000000U, 0xFFFFFFFFU}) {
        Bench bench({}, memory);
        EXPECT_EQ(claim(bench, epoch), AckResult::epoch_jump) << epoch;
        EXPECT_EQ(bench.cell.memory.epoch_held, 1000U);
        EXPECT_FALSE(bench.cell.lease.has_value());
        EXPECT_EQ(claim(bench, 1000U + (1U << 20)), AckResult::ok) << "as far as it may go";
    }
}

TEST(Verify, NamesWhatIsWrongWithTheFileAndMayBeRepeated) {
    const auto verify = [](Bench& bench, const FileCheck& check) {
        EXPECT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
        file_checked(bench.cell, bench.cell.pending->number, check, bench.now, bench.hooks);
        return bench.cell.ack.result;
    };
    Bench bench;
    bench.to_stored();
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::file_missing);
    EXPECT_EQ(verify(bench, {FileCheck::End::missing, 0, {}}), AckResult::file_missing);
    EXPECT_EQ(verify(bench, {FileCheck::End::io_error, 0, {}}), AckResult::store_io);
    EXPECT_EQ(verify(bench, {FileCheck::End::ok, 999, good_digest()}), AckResult::file_size);
    EXPECT_EQ(verify(bench, {FileCheck::End::ok, 1000, Sha256{{1}}}), AckResult::hash_mismatch);
    EXPECT_EQ(bench.status().transfer_state, TransferState::hash_mismatch);
    EXPECT_EQ(bench.status().file_sha256, Sha256{{1}});
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::file_missing);
    EXPECT_EQ(verify(bench, {FileCheck::End::ok, 1000, good_digest()}), AckResult::ok);
    EXPECT_EQ(bench.status().transfer_state, TransferState::complete);
}

TEST(Verify, AnAnswerToAnOlderQuestionIsNotTaken) {
    Bench bench;
    bench.to_stored();
    ASSERT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
    const std::uint64_t number = bench.cell.pending->number;
    ASSERT_EQ(bench.send(CellCommand::cancel, job_a), AckResult::ok);
    file_checked(bench.cell, number, {FileCheck::End::ok, 1000, good_digest()}, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.job.state, JobState::none);
}

TEST(Prepare, ChecksReachStockAndToolBeforeAnybodyIsAsked) {
    CellLimits limits;
    limits.reach = {{-10, -10, 0}, {10, 10, 20}};
    limits.max_stock = {30, 30, 30};
    limits.tools = {{3}, {4}};
    const auto answer = [&](const Change& change) { return prepare(limits, change); };
    EXPECT_EQ(answer([](WireTicket&) {}).first, AckResult::pending);
    EXPECT_EQ(answer([](WireTicket& t) { t.box_max[2] = 2001; }), std::pair(AckResult::envelope, 155U));
    EXPECT_EQ(answer([](WireTicket& t) { t.box_min[0] = -1001; }), std::pair(AckResult::envelope, 145U));
    EXPECT_EQ(answer([](WireTicket& t) { t.stock[1] = 3001; }), std::pair(AckResult::envelope, 159U));
    EXPECT_EQ(answer([](WireTicket& t) { t.stock[0] = 1999; }), std::pair(AckResult::stock_too_small, 157U));
    EXPECT_EQ(answer([](WireTicket& t) { t.tool_no = 9; }), std::pair(AckResult::tool, 164U));
    limits = {};
    EXPECT_EQ(answer([](WireTicket& t) {
                  t.box_min[0] = INT32_MIN;
                  t.box_max[0] = INT32_MAX;
              }).first,
              AckResult::envelope);
}

TEST(Prepare, ChecksTheToolsSizeAndSpeedsAndThatNothingLiesBelowTheTable) {
    CellLimits limits;
    limits.tools = {{3, 12, 18000, 4000}, {4, 6, 24000, 6000}};
    const auto answer = [&](const Change& change) { return prepare(limits, change); };
    const auto sound = [](WireTicket& t) {
        t.tool_diameter_um = 12000;
        t.spindle_max_rpm = 24000;
        t.feed_max_mm_per_min = 6000;
    };
    EXPECT_EQ(answer(sound).first, AckResult::pending) << "at most the largest of the list";
    const auto field = [](std::uint32_t address) { return std::pair(AckResult::ticket_field, address); };
    EXPECT_EQ(answer([](WireTicket& t) { t.tool_diameter_um = 12001; }), field(165));
    EXPECT_EQ(answer([](WireTicket& t) { t.spindle_max_rpm = 24001; }), field(167));
    EXPECT_EQ(answer([](WireTicket& t) { t.feed_max_mm_per_min = 6001; }), field(168));
    EXPECT_EQ(answer([](WireTicket& t) { t.box_min[2] = -1; }), field(149));
}

TEST(Prepare, IsPendingUntilSomebodyConsents) {
    CellLimits limits;
    limits.consent = Consent::ask;
    Bench bench(limits);
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    const std::uint64_t number = bench.cell.pending->number;
    bench.beat();
    bench.pass(1000);
    EXPECT_EQ(bench.cell.ack.result, AckResult::pending);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);  // the same question, not a second one
    EXPECT_EQ(bench.cell.pending->number, number);
    consent_given(bench.cell, number + 1, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::pending);
    consent_given(bench.cell, number, false, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::no_consent);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    consent_given(bench.cell, bench.cell.pending->number, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    const std::uint32_t token = bench.cell.job.token;
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::already);
    EXPECT_EQ(bench.cell.job.token, token);
}

TEST(Prepare, ConsentThatComesAfterTheLeaseHasGonePreparesNothing) {
    CellLimits limits;
    limits.consent = Consent::ask;
    Bench bench(limits);
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    const std::uint64_t number = bench.cell.pending->number;
    bench.pass(6000);
    consent_given(bench.cell, number, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.cell.job.token, 0U);
}

TEST(Prepare, ConsentIsForOneStartOnly) {
    Bench bench;
    bench.to_running();
    bench.pass(102000);
    EXPECT_FALSE(bench.status().has(flag::consent_present));
    EXPECT_FALSE(bench.status().has(flag::block_loaded));
}

TEST(Rehearse, GivesAReceiptThatPrepareAsksForAndMovesNothing) {
    Bench bench;
    WireTicket ticket = good_ticket();
    ticket.requirements = 1;
    bench.to_verified(ticket);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::rehearsal_required);
    ASSERT_EQ(bench.send(CellCommand::rehearse, job_a), AckResult::pending);
    EXPECT_EQ(bench.status().unit_mode, UnitMode::rehearsal);
    EXPECT_TRUE(bench.status().has(flag::rehearsal_running));
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::wrong_mode);
    ASSERT_EQ(bench.send(CellCommand::rehearse, job_a), AckResult::pending);
    bench.pass(1100);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    const std::uint32_t receipt = bench.cell.ack.detail;
    EXPECT_NE(receipt, 0U);
    EXPECT_EQ(bench.status().unit_mode, UnitMode::production);
    EXPECT_EQ(bench.status().job_result, JobResult::rehearsal_passed);
    EXPECT_EQ(bench.status().state, PackState::idle);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a, 0, receipt + 1), AckResult::rehearsal_required);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a, 0, receipt), AckResult::pending);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Chunks, TheFileGrowsOnlyInOrderAndOnlyByItsOwner) {
    Bench bench;
    WireTicket ticket = good_ticket();
    ticket.transfer = Transfer::chunks;
    ticket.file_size = 5;
    bench.to_stored(ticket);
    EXPECT_EQ(bench.status().transfer_state, TransferState::open);
    const std::uint32_t epoch = bench.cell.memory.epoch_held;
    const auto send = [&](std::uint32_t offset, Bytes data, std::uint32_t who = owner) {
        Chunk chunk{offset, std::move(data), 0};
        chunk.crc = chunk_crc(epoch, who, job_a, offset, chunk.data);
        receive_chunk(bench.cell, chunk);
        return bench.cell.transfer_result;
    };
    EXPECT_EQ(send(0, {1, 2, 3}, other_owner), AckResult::chunk_crc);
    EXPECT_EQ(send(1, {1, 2, 3}), AckResult::wrong_offset);
    EXPECT_EQ(send(0, {1, 2, 3}), AckResult::ok);
    EXPECT_EQ(send(0, {1, 2, 3}), AckResult::already);
    EXPECT_EQ(send(0, {1, 2, 4}), AckResult::wrong_offset);
    EXPECT_EQ(send(1, {2, 3, 4}), AckResult::wrong_offset);
    EXPECT_EQ(send(3, {4, 5, 6}), AckResult::file_size);
    EXPECT_EQ(send(0xFFFFFFFF, {1, 2}), AckResult::file_size);
    EXPECT_EQ(bench.send(CellCommand::verify, job_a), AckResult::file_missing);
    EXPECT_EQ(send(3, {4, 5}), AckResult::ok);
    EXPECT_EQ(bench.status().transfer_next, 5U);
    EXPECT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
    // Wrong after all: it comes again from the beginning.
    file_checked(bench.cell, bench.cell.pending->number, {FileCheck::End::ok, 5, Sha256{{1}}}, bench.now, bench.hooks);
    EXPECT_EQ(bench.status().transfer_next, 0U);
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
