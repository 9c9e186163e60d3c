// The words of one line of a program in any language, and the error for a line that cannot be interpreted.
//
// O(characters passed); nothing is kept but views into the text (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"

namespace qchopper {

// Letters A-Z made small.
std::string lower_case(std::string_view text);

// Of kind mesh; its message names file and line too.
class LineRefused : public InputError {
 public:
    LineRefused(const std::string& file_name, std::size_t line_number, const std::string& reason);

    std::string file;
    std::size_t line;  // from 1
    std::string why;
};

// Throws LineRefused.
[[noreturn]] void refuse_line(const std::string& file, std::size_t line, const std::string& why);

// Reads a line from left to right. What is asked for and does not stand there is refused by refuse_line().
class ProgramLine {
 public:
    // Both texts must outlive it.
    ProgramLine(std::string_view text, const std::string& file, std::size_t line)
        : rest_(text), file_(&file), line_(line) {}

    // The next word: letters, digits, _ and $, in lower case; empty if none begins here.
    std::string word();
    // Whether the next word is this one, in lower case, which is then passed.
    bool takes_word(std::string_view lower);
    // The next letter, in lower case, passed; 0 if none stands there.
    char letter();
    // Whether the line goes on with this text, in lower case, white space passed, which is then passed.
    bool takes_text(std::string_view lower);
    // Up to the next quote, which is passed.
    std::string_view until_quote();
    // Whether the next character, white space passed, is this one, which is then passed.
    bool takes(char c);
    void need(char c);
    void need_word(std::string_view lower);
    // Digits with or without a point, and perhaps a minus, between these bounds. An exponent is refused.
    double number(double least, double largest);
    std::uint32_t integer(std::uint32_t least, std::uint32_t largest);
    // The same in brackets: "[7]".
    std::uint32_t index(std::uint32_t least, std::uint32_t largest);
    void need_end();
    [[noreturn]] void refuse(const std::string& why) const { refuse_line(*file_, line_, why); }

 private:
    void pass_space();

    std::string_view rest_;
    const std::string* file_;
    std::size_t line_;
};

}  // namespace qchopper
