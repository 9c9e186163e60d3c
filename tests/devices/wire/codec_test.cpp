// The vectors are written from the register map, register by register, and their checksums were computed by another
// program, so that they do not share a mistake with the codec.

#include "devices/wire/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"

namespace qchopper {
namespace {

// clang-format off
const Registers command_registers{
    0x5143, 0x0100, 0x0000, 0x0005, 0x0000, 0x0009, 0x0002, 0x0000, 0x0001, 0x0203,
    0x0405, 0x0607, 0x0809, 0x0A0B, 0x0C0D, 0x0E0F, 0xDEAD, 0xBEEF, 0x0000, 0x0007,
    0x1234, 0x5678, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA,
    0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0x89AB, 0xCDEF,
    0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000,
    0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x2062, 0x8DB7,
};
const Registers status_registers{
    0x5143, 0x0101, 0x0102, 0x0304, 0x0000, 0x0003, 0x0004, 0x0006, 0x0003, 0x0A08,
    0x0000, 0x0005, 0x002A, 0xFFFF, 0x0000, 0x0009, 0x0002, 0x0001, 0x0000, 0x004D,
    0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0A0B, 0x0C0D, 0x0E0F, 0xDEAD, 0xBEEF,
    0x0003, 0x0007, 0x1388, 0x0000, 0x003D, 0x0000, 0x003E, 0x0001, 0x0000, 0x000C,
    0xFFFF, 0xFFFE, 0x0000, 0x0064, 0x0001, 0x86A0, 0x2710, 0x4650, 0x0001, 0x0000,
    0x01F4, 0x0000, 0x01F5, 0x546F, 0x6F6C, 0x2062, 0x726F, 0x6B65, 0x0000, 0x0000,
    0x0000, 0x0002, 0x0000, 0x1388, 0x0002, 0x0010, 0x0000, 0x0000, 0x0021, 0xBBCC,
    0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC,
    0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0x0000, 0x0004, 0x0000, 0x0190, 0x1234,
    0x5678, 0x89AB, 0xCDEF, 0x89AB, 0xCDEF, 0x0006, 0x0474, 0xB822, 0x0103, 0x0102,
};
const Registers ticket_registers{
    0x0001, 0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0A0B, 0x0C0D, 0x0E0F, 0xAAAA,
    0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA,
    0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0xAAAA, 0x0000, 0x1388, 0x0001, 0x612E, 0x716A,
    0x6F62, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000,
    0x0000, 0x0000, 0x0000, 0x0000, 0x0001, 0xFFFF, 0xD8F0, 0xFFFF, 0xEC78, 0x0000,
    0x0000, 0x0000, 0x2710, 0x0000, 0x1388, 0x0000, 0x1F59, 0x0000, 0x55F0, 0x0000,
    0x2EE0, 0x0000, 0x2710, 0x0001, 0x0003, 0x0000, 0x2EE0, 0x4650, 0x0000, 0x1770,
    0x0000, 0x0014, 0xFFFF, 0x0002, 0x0004, 0x0707, 0x0707, 0x0707, 0x0707, 0x0707,
    0x0707, 0x0707, 0x0707, 0x0000, 0x0190, 0x1234, 0x5678, 0x0001, 0x0001, 0x0002,
    0x0003, 0x0000, 0x0000, 0x0007, 0x0001, 0x0000, 0x0000, 0x0000, 0xE362, 0x1DAC,
};
const Registers result_registers{
    0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0A0B, 0x0C0D, 0x0E0F, 0x0005, 0x0001,
    0x0000, 0x0001, 0x0000, 0x0005, 0x0000, 0x0009, 0x0000, 0x0190, 0x1234, 0x5678,
    0x0000, 0x0190, 0x1234, 0x9999, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC,
    0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC, 0xBBCC,
    0x0000, 0x0058, 0x0000, 0x000B, 0x89AB, 0xCDEF, 0x0000, 0x0000, 0x0000, 0x0000,
    0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000, 0x4133, 0xE2FE,
};
const Registers identity_registers{
    0x5143, 0x0101, 0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0A0B, 0x0C0D, 0x0E0F,
    0x0000, 0x0003, 0x0000, 0x0005, 0x0000, 0x0004, 0x0000, 0x0190, 0x1234, 0x5678,
    0x0000, 0x0000, 0xDDF1, 0xD2CE,
};
// clang-format on

constexpr Uuid job{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

Sha256 digest(std::uint8_t even, std::uint8_t odd) {
    Sha256 all{};
    for (std::size_t i = 0; i < all.bytes.size(); ++i) all.bytes[i] = i % 2 == 0 ? even : odd;
    return all;
}

Command a_command() {
    return {5, 9, CellCommand::start, job, 0xDEADBEEF, 7, 0x12345678, digest(0xAA, 0xAA), 0x89ABCDEF};
}

TEST(Codec, ACommandIsTheseRegisters) {
    EXPECT_EQ(encode(a_command()), command_registers);
    const Decoded<Command> back = decode<Command>(command_registers);
    ASSERT_TRUE(back.is_ok());
    EXPECT_EQ(back.value, a_command());
}

Status a_status() {
    Status s;
    s.snapshot = 0x0102;
    s.heartbeat = 0x0304;
    s.boot_count = 3;
    s.unit_mode = UnitMode::rehearsal;
    s.state = PackState::execute;
    s.state_before = PackState::starting;
    s.flags = flag::simulated | flag::lease_held | flag::job_active;
    s.epoch_held = 5;
    s.lease_left_ds = 42;
    s.cell_id = 0xFFFF;
    s.ack_seq = 9;
    s.ack_command = CellCommand::start;
    s.ack_result = AckResult::ok;
    s.ack_detail = 77;
    s.job_id = job;
    s.token = 0xDEADBEEF;
    s.job_state = JobState::running;
    s.job_result = JobResult::rehearsal_passed;
    s.progress = 5000;
    s.elapsed_s = 61;
    s.remaining_s = 62;
    s.block_no = 65536;
    s.tool_no = 12;
    s.tip = {-2, 100, 100000};
    s.feed_override = 10000;
    s.spindle_rpm = 18000;
    s.alarms = 1;
    s.alarm_code = 500;
    s.alarm_block = 501;
    s.alarm_text = "Tool broke";
    s.transfer_state = TransferState::complete;
    s.transfer_next = 5000;
    s.transfer_result = AckResult::already;
    s.store_free_kib = 1048576;
    s.event_no = 33;
    s.file_sha256 = digest(0xBB, 0xCC);
    s.starts_total = 4;
    s.cell_time_ms = 0x0190'1234'5678;
    s.owner_held = 0x89ABCDEF;
    s.ack_owner = 0x89ABCDEF;
    s.bad_frames = 6;
    s.bad_reason = AckResult::bad_crc;
    return s;
}

TEST(Codec, AStatusIsTheseRegisters) {
    EXPECT_EQ(encode(a_status()), status_registers);
    const Decoded<Status> back = decode<Status>(status_registers);
    ASSERT_TRUE(back.is_ok());
    EXPECT_EQ(back.value, a_status());
}

TEST(Codec, AResultIsTheseRegisters) {
    const ResultRecord result{
        {JobState::ended, JobResult::complete, 1, 5, 9, 0x0190'1234'5678, 0x0190'1234'9999, digest(0xBB, 0xCC), 88},
        job,
        11,
        0x89ABCDEF};
    EXPECT_EQ(encode(result), result_registers);
    const Decoded<ResultRecord> back = decode<ResultRecord>(result_registers);
    ASSERT_TRUE(back.is_ok());
    EXPECT_EQ(back.value, result);
}

Identity an_identity() {
    return {0x0101, job, 3, 5, 4, 0x0190'1234'5678};
}

TEST(Codec, AnIdentityIsTheseRegisters) {
    EXPECT_EQ(encode(an_identity()), identity_registers);
    const Decoded<Identity> back = decode<Identity>(identity_registers);
    ASSERT_TRUE(back.is_ok());
    EXPECT_EQ(back.value, an_identity());
}

JobTicket a_ticket() {
    JobTicket ticket;
    ticket.about.piece = "piece";
    ticket.about.piece_no = 2;
    ticket.about.piece_count = 4;
    ticket.about.project_id.fill(7);
    ticket.about.box = {{-100, -50, 0}, {100, 50, 80.25}};
    ticket.about.stock = {220, 120, 100};
    ticket.about.material = Material::pu_foam;
    ticket.about.tool_no = 3;
    ticket.about.tool_diameter = 12;
    ticket.about.spindle_max_rpm = 18000;
    ticket.about.feed_max_mm_per_min = 6000;
    ticket.about.estimated_time_s = 20;
    ticket.about.part = 2;
    ticket.about.parts = 3;
    ticket.file_name = "a.qjob";
    ticket.file_size = 5000;
    ticket.file_sha256 = digest(0xAA, 0xAA);
    return ticket;
}

WireTicket an_order() {
    WireTicket order;
    order.job_id = job;
    order.created_ms = 0x0190'1234'5678;
    order.cell_id = 7;
    order.made_for = order.requirements = 1;
    order.on_link_loss = LinkLoss::hold;
    return order;
}

TEST(Codec, ATicketIsTheseRegisters) {
    const WireTicket ticket = wire_ticket(a_ticket(), an_order());
    EXPECT_EQ(encode(ticket), ticket_registers);
    const Decoded<WireTicket> back = decode<WireTicket>(ticket_registers);
    ASSERT_TRUE(back.is_ok());
    EXPECT_EQ(back.value, ticket);
}

TEST(Codec, AHeartbeatAndAChunkAreTheseRegisters) {
    const Heartbeat heartbeat{5, 0x89ABCDEF, 17};
    EXPECT_EQ(encode(heartbeat), (Registers{0, 5, 0x89AB, 0xCDEF, 17}));
    EXPECT_EQ(decode<Heartbeat>(encode(heartbeat)).value, heartbeat);
    Chunk chunk{232, {1, 2, 3}, 0};
    chunk.crc = chunk_crc(5, 0x89ABCDEF, job, chunk.offset, chunk.data);
    EXPECT_EQ(chunk.crc, 0xF7CD8CEBU);
    EXPECT_EQ(encode(chunk), (Registers{0, 232, 3, 0xF7CD, 0x8CEB, 0x0102, 0x0300}));
    EXPECT_EQ(decode<Chunk>(encode(chunk)).value, chunk);
}

TEST(Codec, OneWrongBitAnywhereIsNeverTakenForAGoodBlock) {
    const auto flipped = [](Registers registers, std::size_t bit) {
        registers[bit / 16] = static_cast<std::uint16_t>(registers[bit / 16] ^ (1U << bit % 16));
        return registers;
    };
    for (std::size_t bit = 0; bit < 16 * command_registers.size(); ++bit) {
        EXPECT_FALSE(decode<Command>(flipped(command_registers, bit)).is_ok()) << bit;
        EXPECT_FALSE(decode<ResultRecord>(flipped(result_registers, bit)).is_ok()) << bit;
    }
    for (std::size_t bit = 0; bit < 16 * identity_registers.size(); ++bit) {
        EXPECT_FALSE(decode<Identity>(flipped(identity_registers, bit)).is_ok()) << bit;
    }
    for (std::size_t bit = 0; bit < 16 * ticket_registers.size(); ++bit) {
        EXPECT_FALSE(decode<WireTicket>(flipped(ticket_registers, bit)).is_ok()) << bit;
        const bool is_bad_reason = bit / 16 == 98;  // the one register that no checksum covers
        EXPECT_EQ(decode<Status>(flipped(status_registers, bit)).is_ok(), is_bad_reason) << bit;
    }
}

TEST(Codec, ABlockThatIsNotRightIsNamed) {
    Registers registers = status_registers;
    registers[0] = 0x4351;
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::magic);
    registers = status_registers;
    registers[1] = 0x0200;
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::version);
    registers = status_registers;
    registers[99] = 0x0103;
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::torn);
    registers = status_registers;
    registers[40] = 0;
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::crc);
    registers.pop_back();
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::length);
    EXPECT_EQ(decode<Status>(Registers(100, 0)).fault, BlockFault::empty);
    EXPECT_EQ(decode<Command>(Registers(60, 0)).fault, BlockFault::empty);
    // A gateway that swaps the registers of a pair.
    registers = status_registers;
    for (std::size_t i = 0; i + 1 < registers.size(); i += 2) std::swap(registers[i], registers[i + 1]);
    EXPECT_EQ(decode<Status>(registers).fault, BlockFault::magic);
}

// A later version may publish something there, and a cell has to refuse what asks for it.
TEST(Codec, ReservedRegistersOfACellAreIgnoredAndThoseOfADispatcherAreFound) {
    const auto with_crc = [](Registers registers, std::size_t at, std::size_t crc_at) {
        registers[at] = 1;
        const std::uint32_t crc = crc32_of_registers(std::span(registers).first(crc_at));
        registers[crc_at] = static_cast<std::uint16_t>(crc >> 16U);
        registers[crc_at + 1] = static_cast<std::uint16_t>(crc);
        return registers;
    };
    const Identity identity{map_version, {4}, 1, 2, 3, 5, 1};
    EXPECT_EQ(decode<Identity>(with_crc(encode(identity), 21, 22)).value, identity);
    ResultRecord result;
    result.starts = 1;
    result.query_seq = 6;
    EXPECT_EQ(decode<ResultRecord>(with_crc(encode(result), 50, 58)).value, result);
    const Registers command = encode(a_command());
    EXPECT_EQ(used_reserved<Command>(command), std::nullopt);
    for (const std::size_t at : {7U, 40U, 57U}) {
        const Registers changed = with_crc(command, at, 58);
        EXPECT_TRUE(decode<Command>(changed).is_ok());
        EXPECT_EQ(used_reserved<Command>(changed), at);
    }
    Registers ticket(100, 0);
    EXPECT_EQ(used_reserved<WireTicket>(ticket), std::nullopt);
    ticket[97] = 1;
    EXPECT_EQ(used_reserved<WireTicket>(ticket), 197);
    ticket[92] = 1;
    EXPECT_EQ(used_reserved<WireTicket>(ticket), 192);
}

TEST(Codec, ANewerMinorVersionIsTaken) {
    Status status = a_status();
    status.version = 0x0107;
    EXPECT_TRUE(decode<Status>(encode(status)).is_ok());
}

TEST(Codec, AnOlderMinorVersionIsRefused) {
    Status status = a_status();
    status.version = 0x0100;
    EXPECT_EQ(decode<Status>(encode(status)).fault, BlockFault::version);
    EXPECT_EQ(decode<Identity>(encode(Identity{0x0100, {4}, 1, 2, 3, 5, 1})).fault, BlockFault::version);
    EXPECT_EQ(encode(a_command())[1], 0x0100) << "COMMAND has a version of its own";
    EXPECT_TRUE(decode<Command>(encode(a_command())).is_ok());
}

TEST(Codec, AnUndividedJobHasZerosForItsPart) {
    JobTicket whole = a_ticket();
    whole.about.part = whole.about.parts = 0;
    const Registers ticket = encode(wire_ticket(whole, an_order()));
    EXPECT_TRUE(is_all_zero(std::span(ticket).subspan(89, 4)));
}

TEST(Codec, RandomRegistersNeverThrowAndNeverPass) {
    std::mt19937 random(1);
    for (int n = 0; n < 20000; ++n) {
        Registers registers(random() % 130);
        for (std::uint16_t& value : registers) value = static_cast<std::uint16_t>(random());
        EXPECT_FALSE(decode<Status>(registers).is_ok());
        EXPECT_FALSE(decode<Command>(registers).is_ok());
        EXPECT_FALSE(decode<WireTicket>(registers).is_ok());
        EXPECT_FALSE(decode<ResultRecord>(registers).is_ok());
        EXPECT_FALSE(decode<Identity>(registers).is_ok());
        const Decoded<Chunk> chunk = decode<Chunk>(registers);
        EXPECT_TRUE(!chunk.is_ok() || registers.size() == chunk_head + (chunk.value.data.size() + 1) / 2);
    }
}

TEST(Codec, AChunkOfAnotherOwnerJobOrPlaceHasAnotherChecksum) {
    const std::vector<std::uint8_t> data{1, 2, 3};
    const std::uint32_t own = chunk_crc(5, 6, job, 232, data);
    EXPECT_NE(chunk_crc(4, 6, job, 232, data), own);
    EXPECT_NE(chunk_crc(5, 7, job, 232, data), own);
    EXPECT_NE(chunk_crc(5, 6, Uuid{1}, 232, data), own);
    EXPECT_NE(chunk_crc(5, 6, job, 464, data), own);
    EXPECT_NE(chunk_crc(5, 6, job, 232, std::vector<std::uint8_t>{1, 2, 3, 0}), own);
}

TEST(Ticket, LengthsAreRoundedToTheNearestHundredth) {
    JobTicket ticket = a_ticket();
    ticket.about.box.max.z = 80.2549;
    EXPECT_EQ(wire_ticket(ticket, an_order()).box_max[2], 8025);
    ticket.about.box.max.z = -80.256;
    EXPECT_EQ(wire_ticket(ticket, an_order()).box_max[2], -8026);
}

TEST(Ticket, WhatIsNotALengthIsRefused) {
    for (const double wrong : {double{NAN}, double{INFINITY}, -double{INFINITY}, 3e7, -3e7}) {
        JobTicket ticket = a_ticket();
        ticket.about.box.min.x = wrong;
        EXPECT_THROW(wire_ticket(ticket, an_order()), InputError) << wrong;
        ticket = a_ticket();
        ticket.about.stock.y = wrong;
        EXPECT_THROW(wire_ticket(ticket, an_order()), InputError) << wrong;
    }
    JobTicket ticket = a_ticket();
    ticket.about.tool_diameter = -1;
    EXPECT_THROW(wire_ticket(ticket, an_order()), InputError);
}

TEST(Ticket, OnlyPlainFileNamesAreTaken) {
    for (const char* bad :
         {"", ".", "..", ".a", "a/b", "../a", "a b", "\xC3\xA9", "a\\b", "123456789012345678901234567890123"}) {
        JobTicket ticket = a_ticket();
        ticket.file_name = bad;
        EXPECT_THROW(wire_ticket(ticket, an_order()), InputError) << bad;
    }
}

}  // namespace
}  // namespace qchopper
