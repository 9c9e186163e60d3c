// Who may command: epochs, lease, sequence numbers and damaged frames.

#include "sim/cell/machine.h"

#include <gtest/gtest.h>

#include "devices/wire/codec.h"
#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_digest;
using bench::good_ticket;
using bench::job_a;
using bench::owner;
using bench::secret;

constexpr std::uint32_t other_owner = 0x33333333;

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

TEST(Fence, DamagedCommandsAreCountedAllAndToldOnceAMinute) {
    Bench bench;
    std::vector<std::string> lines;
    bench.hooks.log = [&](const std::string& line) { lines.push_back(line); };
    Registers damaged = encode(Command{1, 1, CellCommand::claim, {}, 0, 0, 0, {}, owner});
    damaged[5] ^= 1U;
    const auto send = [&](int count) {
        for (int n = 0; n < count; ++n) receive_command(bench.cell, damaged, bench.now, bench.hooks);
    };
    send(500);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0], "a command that cannot be trusted: BAD_CRC");
    bench.now.steady_ms += 59000;
    send(1);
    EXPECT_EQ(lines.size(), 1U);
    bench.now.steady_ms += 1000;
    send(1);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[1], "a command that cannot be trusted: BAD_CRC, and 500 before it since the last such line");
    EXPECT_EQ(bench.cell.bad_frames, 502);
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
        bench.heartbeat();
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
    bench.heartbeat();
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
        bench.heartbeat();
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

// It may ask for something that this cell does not know: nothing of it is done.
TEST(Frames, ACommandThatUsesReservedRegistersIsRefusedWithTheirAddress) {
    for (const std::uint16_t at : {7, 40, 57}) {
        Bench bench;
        bench.to_prepared();
        const Command start{bench.cell.memory.epoch_held,
                            ++bench.seq,
                            CellCommand::start,
                            job_a,
                            bench.cell.job.token,
                            0,
                            0,
                            good_digest(),
                            owner};
        Registers registers = encode(start);
        registers[at] = 1;
        const std::uint32_t crc = crc32_of_registers(std::span(registers).first(58));
        registers[58] = static_cast<std::uint16_t>(crc >> 16U);
        registers[59] = static_cast<std::uint16_t>(crc);
        receive_command(bench.cell, registers, bench.now, bench.hooks);
        EXPECT_EQ(bench.cell.ack.result, AckResult::unknown_cmd);
        EXPECT_EQ(bench.cell.ack.detail, at);
        EXPECT_EQ(bench.cell.memory.starts_total, 0U);
        EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::ok)
            << "the token is not burnt";
    }
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

}  // namespace
}  // namespace qchopper
