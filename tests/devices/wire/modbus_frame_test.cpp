#include "devices/wire/modbus_frame.h"

#include <gtest/gtest.h>

#include <random>

namespace qchopper {
namespace {

constexpr ModbusRequest a_read{0x1234, 0xFF, ModbusFunction::read_input, 100, 2};
const Registers three_registers{1, 2, 0xABCD};

ModbusRequest a_write() {
    return {0x0102, 17, ModbusFunction::write_holding, 0x0205, 3, three_registers};
}

// By hand, after the specification of Modbus TCP.
TEST(ModbusFrame, RequestsAreTheBytesOfTheSpecification) {
    EXPECT_EQ(frame_of(a_read), (Bytes{0x12, 0x34, 0, 0, 0, 6, 0xFF, 4, 0, 100, 0, 2}));
    EXPECT_EQ(frame_of(a_write()), (Bytes{1, 2, 0, 0, 0, 13, 17, 16, 2, 5, 0, 3, 6, 0, 1, 0, 2, 0xAB, 0xCD}));
    ModbusRequest holding = a_read;
    holding.function = ModbusFunction::read_holding;
    EXPECT_EQ(frame_of(holding)[7], 3);
}

const Bytes read_answer{0x12, 0x34, 0, 0, 0, 7, 0xFF, 4, 4, 0xCA, 0xFE, 0, 9};
const Bytes write_answer{1, 2, 0, 0, 0, 6, 17, 16, 2, 5, 0, 3};
const Bytes refusal{0x12, 0x34, 0, 0, 0, 3, 0xFF, 0x84, 2};

TEST(ModbusFrame, ARightAnswerIsTaken) {
    EXPECT_EQ(check_answer(a_read, read_answer).wanted, read_answer.size());
    EXPECT_EQ(check_answer(a_read, read_answer).wrong, "");
    EXPECT_EQ(decode_answer(a_read, read_answer).registers, (Registers{0xCAFE, 9}));
    EXPECT_EQ(check_answer(a_write(), write_answer).wanted, write_answer.size());
    EXPECT_EQ(check_answer(a_write(), write_answer).wrong, "");
    EXPECT_TRUE(decode_answer(a_write(), write_answer).is_ok());
    EXPECT_EQ(check_answer(a_read, refusal).wanted, refusal.size());
    EXPECT_EQ(decode_answer(a_read, refusal).end, BusEnd::exception);
    EXPECT_EQ(decode_answer(a_read, refusal).exception, 2);
}

// Everything but the registers themselves and the code of an exception is fixed by the request.
TEST(ModbusFrame, EveryOtherValueOfEveryFixedByteIsSeen) {
    const auto check = [](const ModbusRequest& request, const Bytes& right, std::size_t fixed) {
        for (std::size_t at = 0; at < fixed; ++at) {
            for (int value = 0; value < 256; ++value) {
                Bytes answer = right;
                if (answer[at] == value) continue;
                answer[at] = static_cast<std::uint8_t>(value);
                EXPECT_FALSE(check_answer(request, answer).wrong.empty()) << "byte " << at << " is " << value;
            }
        }
    };
    check(a_read, read_answer, 9);
    check(a_write(), write_answer, write_answer.size());
    check(a_read, refusal, 8);
}

TEST(ModbusFrame, AFaultIsSeenAsSoonAsItsByteIsThere) {
    for (std::size_t length = 0; length < read_answer.size(); ++length) {
        const std::span<const std::uint8_t> some = std::span(read_answer).first(length);
        EXPECT_EQ(check_answer(a_read, some).wrong, "") << length;
        EXPECT_GT(check_answer(a_read, some).wanted, length);
    }
    const Bytes text{'S', 'S', 'H', '-', '2'};
    EXPECT_FALSE(check_answer(a_read, std::span(text).first(2)).wrong.empty());
}

TEST(ModbusFrame, AnExceptionThatDoesNotExistIsNoAnswer) {
    for (int code = 0; code < 256; ++code) {
        Bytes answer = refusal;
        answer[8] = static_cast<std::uint8_t>(code);
        EXPECT_EQ(check_answer(a_read, answer).wrong.empty(), code >= 1 && code <= 11) << code;
    }
}

TEST(ModbusFrame, BytesAtRandomNeverLeadOutOfTheFrame) {
    std::mt19937 random(7);
    for (int n = 0; n < 20000; ++n) {
        Bytes bytes = read_answer;
        bytes.resize(random() % 20);
        for (int i = 0; i < 2 && !bytes.empty(); ++i) {
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        }
        const AnswerSoFar so_far = check_answer(a_read, bytes);
        EXPECT_LE(so_far.wanted, read_answer.size());
        if (so_far.wrong.empty() && so_far.wanted == bytes.size()) decode_answer(a_read, bytes);
    }
}

}  // namespace
}  // namespace qchopper
