// Faults of section "what goes wrong with jobs and owners", on the cell's side; in time that is counted.

#include <gtest/gtest.h>

#include "sim/cell/modbus_pdu.h"
#include "sim/cell/panel.h"
#include "tests/sim/cell/cell_bench.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_digest;
using bench::good_ticket;
using bench::job_a;
using bench::job_b;
using bench::owner;
using bench::secret;

constexpr std::uint32_t other = 0x33333333;

Command start_of(const Bench& bench, std::uint32_t epoch, std::uint32_t who) {
    return {epoch, 0, CellCommand::start, job_a, bench.cell.job.token, 0, 0, good_digest(), who};
}

TEST(Fault, F08_F34_AStartThatWasHeldBackWhileAnotherTookTheCellOverStartsNothing) {
    CellLimits limits;
    limits.takeover_code = 4711;
    Bench bench(limits);
    bench.to_prepared();
    Command start = start_of(bench, bench.cell.memory.epoch_held, owner);
    start.seq = ++bench.seq;
    ASSERT_EQ(bench.claim(other, 5, 4711), AckResult::ok);
    receive_command(bench.cell, encode(start), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.owner, owner);
    EXPECT_EQ(bench.cell.ack.result, AckResult::stale_epoch);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(bench.cell.state, PackState::idle);
}

TEST(Fault, F10_AStartOfYesterdayIsBadWhateverItsEpoch) {
    Bench bench;
    bench.to_prepared();
    const Command old = start_of(bench, bench.cell.memory.epoch_held, owner);
    ASSERT_EQ(bench.send(old), AckResult::ok);
    bench.pass(200000);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    bench.to_prepared(good_ticket(job_b));
    EXPECT_EQ(bench.send(old), AckResult::stale_epoch);
    Command fresh = old;
    fresh.epoch = bench.cell.memory.epoch_held;
    fresh.job_id = job_b;
    EXPECT_EQ(bench.send(fresh), AckResult::token_bad);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Fault, F33_TwoPcsWithTheSameEpochAndTheSameNumbers) {
    Bench bench;
    const Command first{1, 1, CellCommand::claim, {}, 0, 0, secret, {}, owner};
    const Command second{1, 1, CellCommand::claim, {}, 0, 0, secret + 1, {}, other};
    receive_command(bench.cell, encode(first), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    receive_command(bench.cell, encode(second), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.owner, other) << "whose acknowledgement it is can be seen";
    EXPECT_EQ(bench.cell.ack.result, AckResult::stale_epoch);
    EXPECT_EQ(bench.status().owner_held, owner);
    Command reset{1, 2, CellCommand::reset, {}, 0, 0, 0, {}, other};
    receive_command(bench.cell, encode(reset), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::not_owner);
    reset.owner = owner;
    receive_command(bench.cell, encode(reset), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
}

TEST(Fault, F33_ASecondPcIsToldWhoHasTheCell) {
    Bench bench;
    bench.to_prepared();
    EXPECT_EQ(bench.claim(other, 5), AckResult::lease_busy);
    EXPECT_EQ(bench.cell.ack.detail, owner);
    EXPECT_EQ(bench.cell.job.state, JobState::prepared) << "a refused claim changes nothing";
}

TEST(Fault, F35_TheSameJobTwiceIsOneJob) {
    Bench bench;
    bench.to_stored();
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::already);
    bench.write_ticket(good_ticket(job_b));
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::busy_other_job);
}

TEST(Fault, F35_AFileThatWasStartedBeforeIsFoundByItsHash) {
    Bench bench;
    const auto ask = [&](const Sha256& file) {
        Command query;
        query.command = CellCommand::query_file;
        query.owner = other;  // without a lease
        query.file_sha256 = file;
        const AckResult result = bench.send(query);
        EXPECT_EQ(bench.cell.answer.query_owner, other);
        EXPECT_EQ(bench.cell.answer.query_seq, bench.seq);
        return result;
    };
    EXPECT_EQ(ask(good_digest()), AckResult::unknown_job);
    EXPECT_EQ(bench.cell.answer.job_id, Uuid{});
    bench.to_running();
    EXPECT_EQ(ask(good_digest()), AckResult::ok);
    EXPECT_EQ(bench.cell.answer.job_id, job_a);
    EXPECT_EQ(bench.cell.answer.state, JobState::running);
    EXPECT_EQ(bench.cell.ack.detail, 1U);
    bench.pass(102000);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    arm(bench.cell, {Fault::clock_jump, -86400}, bench.now);
    bench.to_running(good_ticket(job_b));
    EXPECT_EQ(ask(good_digest()), AckResult::ok);
    EXPECT_EQ(bench.cell.answer.job_id, job_b) << "the last one, also if the clock went back";
    EXPECT_EQ(bench.cell.ack.detail, 2U);
    EXPECT_EQ(ask(Sha256{{1}}), AckResult::unknown_job);
    EXPECT_EQ(bench.cell.ack.detail, 0U);
    EXPECT_EQ(bench.cell.answer.starts, 0U);
}

TEST(Fault, F35_AStoredOrCancelledJobIsNoStartOfItsFile) {
    Bench bench;
    bench.to_prepared();
    EXPECT_EQ(bench.send(CellCommand::query_file), AckResult::unknown_job);
    ASSERT_EQ(bench.send(CellCommand::cancel, job_a), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::query_file), AckResult::unknown_job);
    EXPECT_EQ(bench.send(CellCommand::query_file, job_a), AckResult::wrong_job) << "its JOB_ID is 0";
}

TEST(Fault, F35_ACancelledJobIsGoneAndHasNothingToClear) {
    Bench bench;
    bench.to_stored();
    ASSERT_EQ(bench.send(CellCommand::cancel, job_a), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::already);
    EXPECT_EQ(bench.send(CellCommand::clear_result, job_b), AckResult::unknown_job);
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::cancelled) << "for ever";
}

TEST(Fault, F36_TheSameJobIdWithAnotherFile) {
    WireTicket changed = good_ticket();
    changed.file_sha256.bytes.fill(1);
    Bench stored;
    stored.to_stored();
    stored.write_ticket(changed);
    EXPECT_EQ(stored.send(CellCommand::store, job_a), AckResult::job_id_reused);
    Bench running;
    running.to_running();
    running.write_ticket(changed);
    EXPECT_EQ(running.send(CellCommand::store, job_a), AckResult::job_id_reused);
    EXPECT_EQ(running.cell.job.ticket.file_sha256, good_digest());
}

TEST(Fault, F37_AFileThatChangedBeforeItWasTaken) {
    Bench bench;
    bench.to_stored();
    ASSERT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
    file_checked(bench.cell, bench.cell.pending->number, {FileCheck::End::ok, 1000, Sha256{{1}}}, bench.now,
                 bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::hash_mismatch);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::file_missing);
}

TEST(Fault, F38_AFileThatIsMissingEmptyTooLargeOrOfAnotherSize) {
    const auto stored = [](std::uint32_t size, Transfer transfer) {
        Bench bench;
        bench.cell.store_free_kib = 1000;
        bench.to_idle();
        WireTicket ticket = good_ticket();
        ticket.file_size = size;
        ticket.transfer = transfer;
        bench.write_ticket(ticket);
        return bench.send(CellCommand::store, job_a);
    };
    EXPECT_EQ(stored(0, Transfer::drop_folder), AckResult::ticket_field);
    for (const Transfer transfer : {Transfer::drop_folder, Transfer::chunks}) {
        EXPECT_EQ(stored(1000 * 1024, transfer), AckResult::store_full);
        EXPECT_EQ(stored(0xFFFFFFFF, transfer), AckResult::store_full);
    }
    for (const auto& [check, result] : {std::pair(FileCheck{FileCheck::End::missing, 0, {}}, AckResult::file_missing),
                                        std::pair(FileCheck{FileCheck::End::ok, 0, {}}, AckResult::file_size),
                                        std::pair(FileCheck{FileCheck::End::ok, 1001, {}}, AckResult::file_size)}) {
        Bench bench;
        bench.to_stored();
        ASSERT_EQ(bench.send(CellCommand::verify, job_a), AckResult::pending);
        file_checked(bench.cell, bench.cell.pending->number, check, bench.now, bench.hooks);
        EXPECT_EQ(bench.cell.ack.result, result);
    }
}

TEST(Fault, F39_ChunksLostTwiceAndInAnyOrderMakeTheRightFile) {
    Bench bench;
    Bytes file(1000);
    for (std::size_t i = 0; i < file.size(); ++i) file[i] = static_cast<std::uint8_t>(i * 7);
    WireTicket ticket = good_ticket();
    ticket.transfer = Transfer::chunks;
    bench.to_stored(ticket);
    std::uint64_t random = 5;
    int wrong = 0;
    for (int n = 0; n < 2000 && bench.cell.job.chunks.size() < file.size(); ++n) {
        const std::uint32_t next = bench.status().transfer_next;
        const auto offset = static_cast<std::uint32_t>(random++ % 3 == 0 ? next : 100 * (random * 31 % 10));
        const auto begin = file.begin() + offset;
        Chunk chunk{offset, Bytes(begin, begin + std::min<std::ptrdiff_t>(100, file.end() - begin)), 0};
        chunk.crc = chunk_crc(bench.cell.memory.epoch_held, owner, job_a, offset, chunk.data);
        receive_chunk(bench.cell, chunk);
        wrong += is_refusal(bench.cell.transfer_result) ? 1 : 0;
    }
    EXPECT_EQ(bench.cell.job.chunks, file);
    EXPECT_GT(wrong, 0);
}

TEST(Fault, F41_WhatDoesNotFitTheCellIsRefusedWithItsField) {
    CellLimits limits;
    limits.workspace = {{-10, -10, 0}, {10, 10, 20}};
    limits.tools = {{3, 12, 18000, 6000}};
    const auto prepared = [&](void (*change)(WireTicket&)) {
        Bench bench(limits);
        WireTicket ticket = good_ticket();
        change(ticket);
        bench.to_verified(ticket);
        const AckResult result = bench.send(CellCommand::prepare, job_a);
        return std::pair(result, bench.cell.ack.detail);
    };
    EXPECT_EQ(prepared([](WireTicket& t) { t.box_max[0] = 1001; }), std::pair(AckResult::envelope, 151U));
    EXPECT_EQ(prepared([](WireTicket& t) { t.tool_no = 4; }), std::pair(AckResult::tool, 164U));
    EXPECT_EQ(prepared([](WireTicket& t) { t.stock[2] = 1999; }), std::pair(AckResult::stock_too_small, 161U));
    Bench bench(limits);
    bench.to_idle();
    WireTicket ticket = good_ticket();
    ticket.tool_diameter_um = 0;
    bench.write_ticket(ticket);
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ticket_field);
    EXPECT_EQ(bench.cell.ack.detail, 165U);
}

// The tests of the tickets refuse what is not a number: tests/devices/wire/codec_test.cpp.

TEST(Fault, F43_StartOfTheNamedJobInEveryStateSaysWhatItIs) {
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        const auto state = static_cast<PackState>(n);
        if (state == PackState::idle) continue;
        for (const bool has_run : {false, true}) {
            Bench bench;
            bench.to_prepared();
            const std::uint32_t token = bench.cell.job.token;
            bench.cell.state = state;
            if (has_run) bench.cell.job.state = has_active_job(state) ? JobState::running : JobState::ended;
            const AckResult expected = !has_run                ? AckResult::wrong_state
                                       : has_active_job(state) ? AckResult::already
                                                               : AckResult::already_finished;
            EXPECT_EQ(bench.send(CellCommand::start, job_a, token), expected) << n << has_run;
            EXPECT_EQ(bench.cell.state, state);
            EXPECT_EQ(bench.cell.memory.starts_total, 0U);
        }
    }
}

TEST(Fault, F45_ALateStopForAnotherJob) {
    Bench bench;
    bench.to_running(good_ticket(job_b));
    bench.pass(1000);
    for (const CellCommand command : {CellCommand::stop, CellCommand::hold, CellCommand::abort}) {
        EXPECT_EQ(bench.send(command, job_a), AckResult::wrong_job) << name(command);
        EXPECT_EQ(bench.cell.state, PackState::execute);
    }
}

TEST(Fault, F46_AnAbortOfSomebodyElseWithTheRightJobIsTaken) {
    Bench bench;
    bench.to_running();
    bench.pass(1000);
    const Command abort{0, 0, CellCommand::abort, job_a, 0, 0, 0, {}, other};
    EXPECT_EQ(bench.send(abort), AckResult::ok);
    EXPECT_EQ(bench.cell.state, PackState::aborting);
    EXPECT_EQ(bench.status().owner_held, owner) << "the lease is not touched";
}

TEST(Fault, F47_TokensAndReceiptsOfAnotherCellAreBad) {
    Bench bench;
    bench.to_prepared();
    Bench elsewhere;
    elsewhere.cell.random = 99;
    elsewhere.to_prepared();
    ASSERT_NE(bench.cell.job.token, elsewhere.cell.job.token);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, elsewhere.cell.job.token), AckResult::token_bad);
    Bench verified;
    verified.to_verified();
    EXPECT_EQ(verified.send(CellCommand::prepare, job_a, 0, 4711), AckResult::rehearsal_required);
    Bench idle;
    idle.to_idle();
    WireTicket real = good_ticket();
    real.made_for = 0;
    idle.write_ticket(real);
    EXPECT_EQ(idle.send(CellCommand::store, job_a), AckResult::ticket_field);
    EXPECT_EQ(idle.cell.ack.detail, 194U);
}

TEST(Fault, F62_GarbageInAllHoldingRegistersStartsNothing) {
    Bench bench;
    bench.to_prepared();
    for (const std::uint16_t value : {0x0001, 0x5143, 0xAAAA, 0xFFFF}) {
        for (const Block* block : all_blocks()) {
            if (block->side != Side::holding) continue;
            const Registers registers(block->count, value);
            answer_pdu(1, rig::write_request(block->base, registers), bench.cell, bench.now, bench.hooks);
        }
    }
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(bench.cell.state, PackState::idle);
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
}

TEST(Fault, F63_AnAcknowledgementThatWasOvertakenIsRepeatedAndActsOnce) {
    Bench bench;
    bench.to_prepared();
    Command start = start_of(bench, bench.cell.memory.epoch_held, owner);
    ASSERT_EQ(bench.send(start), AckResult::ok);
    start.seq = bench.seq;
    const Command query{0, 0, CellCommand::query, job_a, 0, 0, 0, {}, other};
    ASSERT_EQ(bench.send(query), AckResult::ok);
    EXPECT_EQ(bench.status().ack_owner, other);
    receive_command(bench.cell, encode(start), bench.now, bench.hooks);
    EXPECT_EQ(bench.status().ack_owner, owner);
    EXPECT_EQ(bench.status().ack_result, AckResult::ok);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Parts, ThatFitEachOtherAreTaken) {
    const auto stored = [](std::uint16_t part, std::uint16_t parts) {
        Bench bench;
        bench.to_idle();
        WireTicket ticket = good_ticket();
        ticket.part = part;
        ticket.parts = parts;
        bench.write_ticket(ticket);
        return bench.send(CellCommand::store, job_a);
    };
    EXPECT_EQ(stored(0, 0), AckResult::ok);
    EXPECT_EQ(stored(1, 1), AckResult::ok);
    EXPECT_EQ(stored(3, 3), AckResult::ok);
    EXPECT_EQ(stored(0, 2), AckResult::ticket_field);
    EXPECT_EQ(stored(3, 2), AckResult::ticket_field);
    EXPECT_EQ(stored(1, 0), AckResult::ticket_field);
}

}  // namespace
}  // namespace qchopper
