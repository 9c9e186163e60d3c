#include "devices/wire/register_writer.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(Registers, NumbersHaveTheHighRegisterFirst) {
    EXPECT_EQ(RegisterWriter().u32(305419896).registers(), (Registers{0x1234, 0x5678}));
    EXPECT_EQ(RegisterWriter().i32(-2).registers(), (Registers{0xFFFF, 0xFFFE}));
    EXPECT_EQ(RegisterWriter().u64(0x0123456789ABCDEF).registers(), (Registers{0x0123, 0x4567, 0x89AB, 0xCDEF}));
}

TEST(Registers, TextHasTheFirstCharacterInTheHighByte) {
    EXPECT_EQ(RegisterWriter().text("AB", 1).registers(), (Registers{0x4142}));
    EXPECT_EQ(RegisterWriter().text("ABC", 3).registers(), (Registers{0x4142, 0x4300, 0}));
    EXPECT_EQ(RegisterWriter().text("ABCDEF", 2).registers(), (Registers{0x4142, 0x4344}));
}

TEST(Registers, TextIsNeverCutInsideACharacter) {
    EXPECT_EQ(cut_utf8("a\xC3\xA9", 2), "a");
    EXPECT_EQ(cut_utf8("\xE2\x82\xAC\xE2\x82\xAC", 5), "\xE2\x82\xAC");
    EXPECT_EQ(cut_utf8("abc", 3), "abc");
    EXPECT_EQ(cut_utf8("\xC3\xA9", 0), "");
}

TEST(Registers, TheChecksumIsThatOfIeee8023) {
    const std::vector<std::uint8_t> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(crc32_of(digits), 0xCBF43926U);
    EXPECT_EQ(crc32_of({}), 0U);
    // The same as of the bytes 31 32 33 34.
    const Registers registers{0x3132, 0x3334};
    EXPECT_EQ(crc32_of_registers(registers), crc32_of(std::span(digits).first(4)));
}

TEST(Registers, ReadingGivesBackWhatWasWritten) {
    const std::vector<std::uint8_t> odd{1, 2, 3};
    const Registers registers = RegisterWriter()
                                    .u16(7)
                                    .u32(0xDEADBEEF)
                                    .u64(0x0102030405060708)
                                    .i32(-123456)
                                    .bytes(odd)
                                    .text("hello", 4)
                                    .zeros(2)
                                    .u16(9)
                                    .registers();
    RegisterReader reader(registers);
    EXPECT_EQ(reader.u16(), 7);
    EXPECT_EQ(reader.u32(), 0xDEADBEEFU);
    EXPECT_EQ(reader.u64(), 0x0102030405060708U);
    EXPECT_EQ(reader.i32(), -123456);
    std::vector<std::uint8_t> back(3);
    reader.bytes(back);
    EXPECT_EQ(back, odd);
    EXPECT_EQ(reader.text(4), "hello");
    reader.skip(2);
    EXPECT_EQ(reader.u16(), 9);
}

TEST(Registers, BehindTheEndEverythingIsZero) {
    const Registers one{5};
    RegisterReader reader(one);
    EXPECT_EQ(reader.u64(), std::uint64_t{5} << 48);
    EXPECT_EQ(reader.u32(), 0U);
    EXPECT_EQ(reader.text(3), "");
}

}  // namespace
}  // namespace qchopper
