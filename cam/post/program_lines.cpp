// Digits by fixed() of base/text.h, which no locale changes.

#include "cam/post/program_lines.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace qchopper {

void ProgramLines::line(std::string_view text) {
    bytes_ += text;
    bytes_ += "\r\n";
    ++lines_;
}

void ProgramLines::comment(std::string_view text) {
    line(std::string(comment_begin_) + as_ascii(text) + std::string(comment_end_));
}

void ProgramLines::append(const ProgramLines& other) {
    bytes_ += other.bytes_;
    lines_ += other.lines_;
}

std::string as_ascii(std::string_view text) {
    std::string ascii(text);
    std::replace_if(
        ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '_');
    return ascii;
}

std::string written_number(std::string_view what, double value, int decimals, double largest) {
    if (!(std::abs(value) < largest)) {
        throw InputError(InputFault::use, std::string(what) + " = " + significant(value, 6) +
                                              " cannot be written into a program: not below " +
                                              significant(largest, 6) + " in size");
    }
    return fixed(value, decimals);
}

std::string written_mm(std::string_view what, double value, int decimals) {
    constexpr double farthest = 5000;
    return written_number(what, value, decimals, farthest);
}

}  // namespace qchopper
