#include "sim/cell/modbus_pdu.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/sim/cell/cell_bench.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using bench::Bench;
using rig::read_request;
using rig::write_request;

Bytes answer(Bench& bench, const Bytes& pdu, std::uint8_t unit = 1) {
    return answer_pdu(unit, pdu, bench.cell, bench.now, bench.hooks);
}

Bytes exception(std::uint8_t function, std::uint8_t code) {
    return {static_cast<std::uint8_t>(function | 0x80), code};
}

TEST(Pdu, AStatusReadIsTheStatus) {
    Bench bench;
    const Bytes bytes = answer(bench, read_request(4, 0, 100));
    ASSERT_EQ(bytes.size(), 202U);
    EXPECT_EQ(bytes[0], 4);
    EXPECT_EQ(bytes[1], 200);
    Registers registers;
    for (std::size_t i = 2; i < bytes.size(); i += 2)
        registers.push_back(static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]));
    const Decoded<Status> status = decode<Status>(registers);
    ASSERT_TRUE(status.is_ok());
    EXPECT_EQ(status.value, bench.status());
}

TEST(Pdu, PartOfABlockIsTheSameRegistersAsInTheWhole) {
    Bench bench;
    const Bytes whole = answer(bench, read_request(4, 0, 100));
    for (std::uint16_t at = 0; at < 100; ++at) {
        const Bytes one = answer(bench, read_request(4, at, 1));
        EXPECT_EQ(one, (Bytes{4, 2, whole[2U + 2U * at], whole[3U + 2U * at]})) << at;
    }
}

TEST(Pdu, ReadsStayInsideOneBlock) {
    Bench bench;
    const auto is_ok = [&](std::uint8_t function, std::uint16_t at, std::uint16_t count) {
        return answer(bench, read_request(function, at, count))[0] == function;
    };
    for (const Block* block : all_blocks()) {
        const std::uint8_t function = block->side == Side::input ? 4 : 3;
        EXPECT_TRUE(is_ok(function, block->base, block->count)) << block->name;
        EXPECT_TRUE(is_ok(function, static_cast<std::uint16_t>(block->base + block->count - 1), 1)) << block->name;
        const auto last = static_cast<std::uint16_t>(block->base + block->count - 1);
        EXPECT_EQ(answer(bench, read_request(function, last, 2)), exception(function, 2)) << block->name;
    }
    EXPECT_EQ(answer(bench, read_request(4, 100, 1)), exception(4, 2));
    EXPECT_EQ(answer(bench, read_request(3, 60, 1)), exception(3, 2));
    EXPECT_EQ(answer(bench, read_request(3, 99, 2)), exception(3, 2));
    EXPECT_EQ(answer(bench, read_request(4, 65535, 125)), exception(4, 2));
}

TEST(Pdu, WhatWasWrittenIsNeverShown) {
    Bench bench;
    bench.to_prepared();
    answer(bench, write_request(100, encode(bench::good_ticket())));
    for (const Block* block : all_blocks()) {
        if (block->side != Side::holding) continue;
        const Bytes bytes = answer(bench, read_request(3, block->base, block->count));
        EXPECT_TRUE(std::all_of(bytes.begin() + 2, bytes.end(), [](std::uint8_t byte) { return byte == 0; }))
            << block->name;
    }
}

TEST(Fault, F49_CountAndLengthComeBeforeTheAddress) {
    Bench bench;
    EXPECT_EQ(answer(bench, read_request(4, 9999, 0)), exception(4, 3));
    EXPECT_EQ(answer(bench, read_request(4, 9999, 126)), exception(4, 3));
    EXPECT_EQ(answer(bench, read_request(4, 9999, 125)), exception(4, 2));
    Bytes longer = read_request(4, 0, 1);
    longer.push_back(0);
    EXPECT_EQ(answer(bench, longer), exception(4, 3));
    for (std::size_t length = 1; length < 5; ++length) {
        const Bytes whole = read_request(3, 0, 1);
        EXPECT_EQ(answer(bench, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))),
                  exception(3, 3));
    }
    const Bytes good = write_request(500, encode(Heartbeat{1, 2, 3}));
    for (std::size_t length = 1; length < good.size(); ++length) {
        EXPECT_EQ(answer(bench, Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length))),
                  exception(16, 3))
            << length;
    }
    Bytes wrong_bytes = good;
    wrong_bytes[5] = 9;
    EXPECT_EQ(answer(bench, wrong_bytes), exception(16, 3));
    EXPECT_EQ(answer(bench, write_request(0, Registers(124, 0))), exception(16, 3));
    EXPECT_EQ(answer(bench, good), (Bytes{16, 500 >> 8, 500 & 0xFF, 0, 5}));
}

TEST(Fault, F21_F49_OnlyThreeFunctionsAreServed) {
    Bench bench;
    for (int function = 0; function < 256; ++function) {
        if (function == 3 || function == 4 || function == 16) continue;
        Bytes pdu = read_request(static_cast<std::uint8_t>(function), 0, 1);
        EXPECT_EQ(answer(bench, pdu), exception(static_cast<std::uint8_t>(function), 1)) << function;
    }
}

TEST(Fault, F49_OnlyUnitsOneAnd255AreHere) {
    Bench bench;
    for (int unit = 0; unit < 256; ++unit) {
        const bool is_here = unit == 1 || unit == 255;
        const Bytes bytes = answer(bench, read_request(4, 0, 1), static_cast<std::uint8_t>(unit));
        EXPECT_EQ(bytes[0], is_here ? 4 : 0x84) << unit;
        if (!is_here) {
            EXPECT_EQ(bytes[1], 0x0B);
        }
    }
}

TEST(Fault, F21_AnAtomicBlockIsWrittenWholeOrNotAtAll) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t seq = bench.cell.ack.seq;
    Registers start = encode(Command{bench.cell.memory.epoch_held, seq + 1, CellCommand::start, bench::job_a,
                                     bench.cell.job.token, 0, 0, bench::good_digest(), bench::owner});
    const Registers whole = start;
    for (std::size_t count = 1; count < 60; ++count) {
        EXPECT_EQ(answer(bench, write_request(
                                    0, Registers(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(count)))),
                  exception(16, 2));
        EXPECT_EQ(
            answer(bench, write_request(static_cast<std::uint16_t>(60 - count),
                                        Registers(whole.end() - static_cast<std::ptrdiff_t>(count), whole.end()))),
            exception(16, 2));
    }
    start.push_back(0);
    EXPECT_EQ(answer(bench, write_request(0, start)), exception(16, 2));
    EXPECT_EQ(answer(bench, write_request(100, Registers(99, 0))), exception(16, 2));
    EXPECT_EQ(answer(bench, write_request(200, Registers(31, 0))), exception(16, 2));
    EXPECT_EQ(answer(bench, write_request(500, Registers(4, 0))), exception(16, 2));
    EXPECT_EQ(answer(bench, write_request(300, Registers(5, 1))), exception(16, 2));
    EXPECT_EQ(answer(bench, write_request(301, Registers(5, 1))), exception(16, 2));
    Registers chunk = encode(Chunk{0, {1, 2, 3}, 0});
    chunk.push_back(0);
    EXPECT_EQ(answer(bench, write_request(300, chunk)), exception(16, 3));
    EXPECT_EQ(bench.cell.ack.seq, seq);
    EXPECT_EQ(bench.cell.state, PackState::idle);
    EXPECT_EQ(answer(bench, write_request(0, whole))[0], 16);
    EXPECT_EQ(bench.cell.state, PackState::starting);
}

TEST(Fault, F22_ZerosAreInert) {
    Bench bench;
    bench.to_running();
    for (const Block* block : all_blocks()) {
        if (block->side == Side::holding) answer(bench, write_request(block->base, Registers(block->count, 0)));
    }
    EXPECT_EQ(bench.cell.state, PackState::starting);
    EXPECT_EQ(bench.cell.bad_frames, 0);
    EXPECT_TRUE(bench.cell.ticket_draft.empty());
}

TEST(Fault, F52_RandomBytesNeverStartAnythingAndAlwaysGetAWellFormedAnswer) {
    Bench bench;
    bench.to_prepared();
    std::mt19937 random(7);
    const std::uint8_t functions[] = {3, 4, 16, 6, 23};
    const std::uint16_t bases[] = {0, 100, 200, 300, 500};
    for (int n = 0; n < 1000000; ++n) {
        Bytes pdu(random() % 254);
        for (std::uint8_t& byte : pdu) byte = static_cast<std::uint8_t>(random());
        // Half of them look right at the beginning, so that they get past the first checks.
        if (n % 2 == 0 && pdu.size() >= 6) {
            pdu[0] = functions[random() % 5];
            const std::uint16_t base = bases[random() % 5];
            pdu[1] = static_cast<std::uint8_t>(base >> 8);
            pdu[2] = static_cast<std::uint8_t>(base & 0xFF);
            pdu[3] = 0;
            pdu[4] = static_cast<std::uint8_t>((pdu.size() - 6) / 2);
            pdu[5] = static_cast<std::uint8_t>((pdu.size() - 6) / 2 * 2);
        }
        const Bytes bytes = answer(bench, pdu);
        ASSERT_GE(bytes.size(), 2U);
        ASSERT_LE(bytes.size(), 253U);
        const std::uint8_t function = pdu.empty() ? 0 : pdu[0];
        ASSERT_TRUE(bytes[0] == function || bytes == exception(function, bytes[1]));
    }
    EXPECT_EQ(bench.cell.state, PackState::idle);
    EXPECT_EQ(bench.cell.job.state, JobState::prepared);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(bench.cell.lease->owner, bench::owner);
}

TEST(Pdu, ACommandWithRandomContentsAndARightChecksumStartsNothingWithoutTheToken) {
    Bench bench;
    bench.to_prepared();
    std::mt19937 random(8);
    const auto below = [&random](std::uint32_t end) { return static_cast<std::uint32_t>(random()) % end; };
    for (std::uint32_t n = 0; n < 20000; ++n) {
        Command command;
        command.epoch = below(4);
        command.seq = 100 + n;
        command.command = all_commands[below(all_commands.size())];
        command.job_id = below(2) == 0 ? bench::job_a : Uuid{};
        command.token = static_cast<std::uint32_t>(random());
        command.arg0 = below(5);
        command.arg1 = below(5);
        command.file_sha256 = below(2) == 0 ? bench::good_digest() : Sha256{};
        command.owner = below(2) == 0 ? bench::owner : below(5);
        const std::uint32_t token = bench.cell.job.token;
        if (command.token == token) continue;
        ASSERT_EQ(answer(bench, write_request(0, encode(command))), (Bytes{16, 0, 0, 0, 60}));
        bench.pass(10);
        ASSERT_EQ(bench.cell.memory.starts_total, 0U);
    }
}

}  // namespace
}  // namespace qchopper
