#include "base/printable.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace qchopper {
namespace {

// What a real shell makes of a command line, with a mark after every word.
std::string words_of(const std::string& line) {
    const std::string command = "printf '%s|' " + line;
    std::FILE* shell = ::popen(command.c_str(), "r");
    if (shell == nullptr) return "no shell";
    std::string out;
    for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) out += static_cast<char>(c);
    ::pclose(shell);
    return out;
}

TEST(ShellWord, IsOneWordInAShellWhateverItHolds) {
    std::mt19937 random(8);
    const std::string letters = "aZ09 '\"\\$`!*?~#&|;<>()[]{}=%-_./\t\n\xc3\xa4";
    for (int i = 0; i < 150; ++i) {
        std::string name;
        for (std::size_t n = 1 + random() % 8; n > 0; --n) name += letters[random() % letters.size()];
        const std::string expected = (name.front() == '-' ? "./" : "") + name;
        EXPECT_EQ(words_of(shell_word(name)), expected + "|") << name;
    }
}

TEST(ShellWord, LeavesPlainNamesAlone) {
    for (const char* name : {"femur.qch", "/data/scan_3/femur-left.qch", "../a.ply", "a,b=c:d@e%+"}) {
        EXPECT_EQ(shell_word(name), name);
    }
    EXPECT_EQ(shell_word("a bone.qch"), "'a bone.qch'");
    EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace qchopper
