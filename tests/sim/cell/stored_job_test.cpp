// The ticket, the file and its chunks.

#include "sim/cell/machine.h"

#include <gtest/gtest.h>

#include <functional>

#include "devices/wire/register_writer.h"
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
        ASSERT_TRUE(decode<WireTicket>(block).is_ok());
        ASSERT_EQ(decode<WireTicket>(block).value.file_name, "piece-1.qjob");
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

}  // namespace
}  // namespace qchopper
