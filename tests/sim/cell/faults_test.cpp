// The faults of answers, on bytes.

#include "sim/cell/faults.h"

#include <gtest/gtest.h>

#include <set>

#include "sim/cell/modbus_pdu.h"
#include "sim/cell/panel.h"
#include "tests/sim/cell/cell_bench.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using bench::Bench;

const Bytes frame = rig::frame(0x0A0B, {4, 2, 0x51, 0x43});

std::vector<Delivery> delivered(ArmedFault fault) {
    Faults faults{{fault}, 1};
    std::vector<Delivery> parts = deliver(faults, frame);
    EXPECT_TRUE(faults.armed.empty()) << "once";
    return parts;
}

// The places at which the one delivery differs from the right frame.
std::set<std::size_t> changed(ArmedFault fault) {
    const std::vector<Delivery> parts = delivered(fault);
    std::set<std::size_t> places;
    EXPECT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].bytes.size(), frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (parts[0].bytes[i] != frame[i]) places.insert(i);
    }
    return places;
}

Decoded<Status> read_status(Bench& bench) {
    const Bytes bytes = answer_pdu(1, rig::read_request(4, 0, 100), bench.cell, bench.now, bench.hooks);
    Registers registers;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        registers.push_back(static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]));
    }
    return decode<Status>(registers);
}

TEST(Faults, EachHasOneNameAndStandsAtItsPlace) {
    std::set<std::string> names;
    std::size_t place = 0;
    for (const NamedFault& row : all_faults()) {
        EXPECT_EQ(static_cast<std::size_t>(row.fault), place++);
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(fault_named(row.name), &row);
    }
    EXPECT_EQ(fault_named("nothing"), nullptr);
}

TEST(Faults, WithoutOneTheFrameIsSentAtOnce) {
    Faults faults;
    const std::vector<Delivery> parts = deliver(faults, frame);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].bytes, frame);
    EXPECT_EQ(parts[0].after_ms, 0);
    EXPECT_FALSE(parts[0].then_close);
}

TEST(Faults, TheSameSeedDrawsTheSameOnes) {
    const auto drawn = [](std::uint64_t seed) {
        Faults faults{{{Fault::no_answer, 0, 0, 300}}, seed};
        std::string all;
        for (int n = 0; n < 200; ++n) all += take(faults, Fault::no_answer) ? '1' : '0';
        return all;
    };
    EXPECT_EQ(drawn(7), drawn(7));
    EXPECT_NE(drawn(7), drawn(8));
    const std::string all = drawn(7);
    const auto count = std::count(all.begin(), all.end(), '1');
    EXPECT_GT(count, 30);
    EXPECT_LT(count, 90);
}

TEST(Faults, SeveralTimesMeansThatOften) {
    Faults faults{{{Fault::exception, 6, 3}}, 1};
    for (int n = 0; n < 3; ++n) EXPECT_EQ(take(faults, Fault::exception), 6);
    EXPECT_EQ(take(faults, Fault::exception), std::nullopt);
}

TEST(Fault, F03_F05_F07_AnswersThatNeverComeComeLateOrEndInAReset) {
    EXPECT_TRUE(delivered({Fault::no_answer}).empty());
    const std::vector<Delivery> late = delivered({Fault::answer_late, 1500});
    ASSERT_EQ(late.size(), 1U);
    EXPECT_EQ(late[0].after_ms, 1500);
    EXPECT_EQ(late[0].bytes, frame);
    const std::vector<Delivery> reset = delivered({Fault::close_before_answer});
    ASSERT_EQ(reset.size(), 1U);
    EXPECT_TRUE(reset[0].bytes.empty() && reset[0].then_close);
}

TEST(Fault, F04_AnAnswerByteByByteIsTheSameBytes) {
    Bytes all;
    for (const Delivery& part : delivered({Fault::answer_bytewise, 100})) {
        EXPECT_EQ(part.after_ms, 100);
        all.insert(all.end(), part.bytes.begin(), part.bytes.end());
    }
    EXPECT_EQ(all, frame);
}

TEST(Fault, F06_TheConnectionClosesBeforeTheRequestTookEffect) {
    Bench bench;
    bench.to_prepared();
    arm(bench.cell, {Fault::close_before_effect}, bench.now);
    const Command start{
        bench.cell.memory.epoch_held, bench.seq + 1, CellCommand::start, bench::job_a, bench.cell.job.token, 0, 0,
        bench::good_digest(),         bench::owner};
    const Bytes request = rig::write_request(0, encode(start));
    EXPECT_TRUE(answer_pdu(1, request, bench.cell, bench.now, bench.hooks).empty());
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(answer_pdu(1, request, bench.cell, bench.now, bench.hooks)[0], 16);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Fault, F11_F12_HeadersOfAnswersAreWrongInOneFieldEach) {
    EXPECT_EQ(changed({Fault::wrong_transaction}), (std::set<std::size_t>{1}));
    EXPECT_EQ(changed({Fault::wrong_protocol}), (std::set<std::size_t>{3}));
    EXPECT_EQ(changed({Fault::wrong_length, 1}), (std::set<std::size_t>{5}));
    EXPECT_EQ(changed({Fault::wrong_unit}), (std::set<std::size_t>{6}));
    EXPECT_EQ(changed({Fault::wrong_function}), (std::set<std::size_t>{7}));
    EXPECT_EQ(changed({Fault::wrong_echo}), (std::set<std::size_t>{8}));
}

TEST(Fault, F13_ATruncatedAnswerIsItsBeginning) {
    for (const std::size_t kept : {0U, 1U, 6U, 7U, 10U}) {
        const std::vector<Delivery> parts = delivered({Fault::answer_truncated, static_cast<std::int64_t>(kept)});
        ASSERT_EQ(parts.size(), 1U);
        EXPECT_EQ(parts[0].bytes, Bytes(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(kept)));
    }
}

TEST(Fault, F14_F15_F16_ExceptionsAreAnsweredAndTheRequestIsNotHandled) {
    for (const std::uint8_t code : {1, 2, 3, 4, 5, 6, 99}) {
        Bench bench;
        bench.to_idle();
        const std::uint32_t epoch = bench.cell.memory.epoch_held;
        arm(bench.cell, {Fault::exception, code}, bench.now);
        const Command claim{epoch + 1, bench.seq + 1, CellCommand::claim, {}, 0, 0, bench::secret, {}, bench::owner};
        const Bytes request = rig::write_request(0, encode(claim));
        EXPECT_EQ(answer_pdu(1, request, bench.cell, bench.now, bench.hooks), (Bytes{0x90, code}));
        EXPECT_EQ(bench.cell.memory.epoch_held, epoch);
        // The same request once more is safe.
        EXPECT_EQ(answer_pdu(1, request, bench.cell, bench.now, bench.hooks)[0], 16);
        EXPECT_EQ(bench.cell.memory.epoch_held, epoch + 1);
    }
}

TEST(Fault, F17_EveryFlippedBitOfStatusIsFoundAndTheNextReadIsRight) {
    Bench bench;
    for (std::int64_t bit = 0; bit < 1600; ++bit) {
        if (bit / 16 == 98) continue;  // BAD_REASON, which no checksum covers
        arm(bench.cell, {Fault::flip_status, bit}, bench.now);
        EXPECT_FALSE(read_status(bench).is_ok()) << bit;
        EXPECT_TRUE(read_status(bench).is_ok());
    }
}

TEST(Fault, F18_ATornStatusIsNamed) {
    Bench bench;
    arm(bench.cell, {Fault::torn_status}, bench.now);
    EXPECT_EQ(read_status(bench).fault, BlockFault::torn);
    EXPECT_TRUE(read_status(bench).is_ok());
}

TEST(Fault, F19_AFlippedBitInWhatIsWrittenHasNoEffectAndTheRightOneStillHas) {
    Bench bench;
    bench.to_prepared();
    const Command start{
        bench.cell.memory.epoch_held, bench.seq + 1, CellCommand::start, bench::job_a, bench.cell.job.token, 0, 0,
        bench::good_digest(),         bench::owner};
    const Bytes request = rig::write_request(0, encode(start));
    for (std::int64_t bit = 0; bit < 60 * 16; ++bit) {
        arm(bench.cell, {Fault::flip_written, bit}, bench.now);
        answer_pdu(1, request, bench.cell, bench.now, bench.hooks);
        ASSERT_EQ(bench.cell.memory.starts_total, 0U) << bit;
    }
    EXPECT_EQ(bench.cell.bad_frames, 960);
    answer_pdu(1, request, bench.cell, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
}

TEST(Fault, F19_AFlippedBitInTheTicketIsTicketCrc) {
    for (std::int64_t bit = 0; bit < 100 * 16; bit += 7) {
        Bench bench;
        bench.to_idle();
        arm(bench.cell, {Fault::flip_written, bit}, bench.now);
        const Registers ticket = encode(bench::good_ticket());
        answer_pdu(1, rig::write_request(100, ticket), bench.cell, bench.now, bench.hooks);
        EXPECT_EQ(bench.send(CellCommand::store, bench::job_a), AckResult::ticket_crc) << bit;
        answer_pdu(1, rig::write_request(100, ticket), bench.cell, bench.now, bench.hooks);
        EXPECT_EQ(bench.send(CellCommand::store, bench::job_a), AckResult::ok) << bit;
    }
}

TEST(Fault, F19_AFlippedBitInAChunkAddsNothing) {
    Bench bench;
    WireTicket ticket = bench::good_ticket();
    ticket.transfer = Transfer::chunks;
    bench.to_stored(ticket);
    Chunk chunk{0, Bytes(40, 7), 0};
    chunk.crc = chunk_crc(bench.cell.memory.epoch_held, bench::owner, bench::job_a, 0, chunk.data);
    const Registers block = encode(chunk);
    for (std::size_t bit = 0; bit < 16 * block.size(); ++bit) {
        arm(bench.cell, {Fault::flip_written, static_cast<std::int64_t>(bit)}, bench.now);
        answer_pdu(1, rig::write_request(300, block), bench.cell, bench.now, bench.hooks);
        ASSERT_TRUE(bench.cell.job.chunks.empty()) << bit;
    }
    answer_pdu(1, rig::write_request(300, block), bench.cell, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.job.chunks, chunk.data);
}

TEST(Fault, F20_SwappedWordsAreRefusedOnBothSides) {
    Bench bench;
    arm(bench.cell, {Fault::swap_words}, bench.now);
    EXPECT_EQ(read_status(bench).fault, BlockFault::magic);
    Registers block = encode(Command{1, 1, CellCommand::claim, {}, 0, 0, 2, {}, 3});
    for (std::size_t i = 0; i + 1 < block.size(); i += 2) std::swap(block[i], block[i + 1]);
    answer_pdu(1, rig::write_request(0, block), bench.cell, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.bad_reason, AckResult::bad_magic);
    EXPECT_FALSE(bench.cell.lease.has_value());
}

TEST(Fault, F22_ZeroedHoldingRegistersAreInert) {
    Bench bench;
    bench.to_running();
    arm(bench.cell, {Fault::zero_holding}, bench.now);
    const Status before = bench.status();
    const Registers heartbeat = encode(Heartbeat{bench.cell.memory.epoch_held, bench::owner, 9});
    EXPECT_EQ(answer_pdu(1, rig::write_request(500, heartbeat), bench.cell, bench.now, bench.hooks)[0], 16);
    EXPECT_TRUE(bench.cell.faults.armed.empty());
    Status after = bench.status();
    EXPECT_EQ(after.bad_frames, before.bad_frames);
    EXPECT_EQ(after, before);
}

TEST(Fault, F30_TheHeartbeatOfTheCellStandsStillWhileReadsWork) {
    Bench bench;
    arm(bench.cell, {Fault::frozen_heartbeat}, bench.now);
    const std::uint16_t before = read_status(bench).value.heartbeat;
    bench.pass(5000);
    EXPECT_EQ(read_status(bench).value.heartbeat, before);
    disarm_all(bench.cell);
    EXPECT_EQ(read_status(bench).value.heartbeat, before + 10);
}

}  // namespace
}  // namespace qchopper
