#include "base/printable.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

using namespace std::string_literals;

TEST(Printable, LeavesOrdinaryTextAsItIs) {
    for (const char* text :
         {"", "Tool broke", "Säge läuft 20 °C", "\xE2\x82\xAC", "\xF0\x9F\xA6\xB4", "a\\b", "\xC2\xA0"}) {
        EXPECT_EQ(printable(text), text);
    }
}

TEST(Printable, EscapesWhatActsOnATerminal) {
    EXPECT_EQ(printable("\x1b[2J\x1b]0;x\x07"), "\\x1b[2J\\x1b]0;x\\x07");
    EXPECT_EQ(printable("a\r\nb\tc\x7f"), "a\\x0d\\x0ab\\x09c\\x7f");
    EXPECT_EQ(printable("\0x"s), "\\x00x");
    EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b") << "CSI in one character";
    EXPECT_EQ(printable("\xE2\x80\xAE"), "\\xe2\\x80\\xae") << "writing from right to left";
    EXPECT_EQ(printable_lines("a\x1b\nb\n"), "a\\x1b\nb\n");
}

TEST(Printable, EscapesWhatIsNoUtf8) {
    EXPECT_EQ(printable("\x9b"
                        "1m"),
              "\\x9b1m")
        << "CSI of an 8-bit terminal";
    EXPECT_EQ(printable("ab\xC3"), "ab\\xc3") << "cut short";
    EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf") << "longer than needed";
    EXPECT_EQ(printable("\xE0\x80\xAF"), "\\xe0\\x80\\xaf");
    EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
    EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last character";
    EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
}

// Whatever comes in, nothing that comes out acts on a terminal.
TEST(Printable, OfAllPairsOfBytesIsHarmless) {
    for (int a = 0; a < 256; ++a) {
        for (int b = 0; b < 256; ++b) {
            const std::string shown = printable(std::string{static_cast<char>(a), static_cast<char>(b)});
            for (const char c : shown) EXPECT_TRUE(c < 0 || (c >= 0x20 && c != 0x7f)) << a << " " << b;
            EXPECT_EQ(printable(shown), shown) << a << " " << b;
        }
    }
}

}  // namespace
}  // namespace qchopper
