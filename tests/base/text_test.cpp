#include "base/text.h"
#include "base/base64.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "base/edit_distance.h"
#include "base/files/portable_name.h"
#include "base/hex.h"
#include "base/uuid.h"

namespace qchopper {
namespace {

TEST(Text, NumbersAreForPeople) {
    EXPECT_EQ(fixed(12.345, 1), "12.3");
    EXPECT_EQ(fixed(-0.01, 1), "0.0");
    EXPECT_EQ(fixed(-1e-9, 0), "0");
    EXPECT_EQ(fixed(1e300, 0).size(), 301U);
    EXPECT_EQ(describe_volume(1'234'567), "1.235 l");
    EXPECT_EQ(describe_volume(999'600), "1.000 l");
    EXPECT_EQ(describe_volume(320'000), "320 ml");
    EXPECT_EQ(describe_volume(-1'234), "-1.23 ml");
    EXPECT_EQ(describe_volume(0.0123), "0.0000123 ml");
    EXPECT_EQ(describe_volume(0), "0 ml");
    EXPECT_EQ(duration(59), "59 s");
    EXPECT_EQ(duration(89), "1 min");
    EXPECT_EQ(duration(3570), "1 h 00 min");
    EXPECT_EQ(duration(11100), "3 h 05 min");
}

TEST(Text, CountsAndDigits) {
    EXPECT_EQ(counted(1, "hole"), "1 hole");
    EXPECT_EQ(counted(0, "hole"), "0 holes");
    EXPECT_EQ(counted(5000, "hole"), "5,000 holes");
    EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
    EXPECT_EQ(with_commas(0), "0");
    EXPECT_EQ(with_commas(999), "999");
    EXPECT_EQ(with_commas(1234567), "1,234,567");
    EXPECT_EQ(significant(0.00125, 6), "0.00125");
    EXPECT_EQ(significant(1.0 / 3, 3), "0.333");
    EXPECT_EQ(significant(25.4, 6), "25.4");
    EXPECT_EQ(significant(1.5e9, 3), "1.5e+09");
    EXPECT_EQ(significant(std::numeric_limits<double>::infinity(), 3), "inf");
}

TEST(Hex, BackIsTheInverse) {
    std::array<std::uint8_t, 256> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
    EXPECT_EQ(from_hex<256>(to_hex(all)), all);
    EXPECT_EQ(to_hex(std::array<std::uint8_t, 3>{0x00, 0x9f, 0xfa}), "009ffa");
    for (const char* bad : {"", "0", "00f", "0g", "0F", " 0", "000"}) EXPECT_FALSE(from_hex<1>(bad)) << bad;
}

TEST(Uuid, IsWrittenInFiveGroups) {
    Uuid id{};
    for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<std::uint8_t>(i);
    EXPECT_EQ(to_text(id), "00010203-0405-0607-0809-0a0b0c0d0e0f");
}

// The vectors of RFC 4648, section 10.
TEST(Base64, IsThatOfTheRfc) {
    const std::pair<std::string, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(to_base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}), text);
    }
    EXPECT_EQ(to_base64(std::array<std::uint8_t, 3>{0xFB, 0xFF, 0xFE}), "+//+");
}

TEST(PortableName, IsShortAndPlain) {
    for (const char* good : {"A.qjob", "a", "-", "_x.Y-9", "piece-1.qjob", "01234567890123456789012345678901"}) {
        EXPECT_TRUE(is_portable_name(good)) << good;
    }
    for (const char* bad :
         {"", ".", "..", ".A", "a/b", "../a", "a b", "a\\b", "\xc3\xa4", "a\n", "012345678901234567890123456789012"}) {
        EXPECT_FALSE(is_portable_name(bad)) << bad;
    }
    EXPECT_FALSE(is_portable_name(std::string_view("a\0b", 3)));
}

TEST(EditDistance, IsThatOfTheTextbook) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("abc", ""), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("flaw", "lawn"), 2U);
}

TEST(Text, ATimeIsThatOfTheMeridianOfGreenwich) {
    EXPECT_EQ(utc_text(0), "1970-01-01 00:00:00");
    EXPECT_EQ(utc_text(1'795'823'999'999), "2026-11-27 23:59:59");
}

}  // namespace
}  // namespace qchopper
