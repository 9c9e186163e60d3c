// Words, numbers and line counts of a text that lies in memory.
//
// Line ends may be LF, CR LF or CR alone. Numbers are read without regard to the locale.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace qchopper {

class Text {
 public:
    explicit Text(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    // The next run of characters without white space; empty at the end.
    std::string_view word();
    // What is left of the line, without its end; the line end is passed.
    std::string_view rest_of_line();
    // The line of the last word or rest, from 1.
    std::size_t line() const { return line_; }
    bool at_end() const { return at_ == end_; }
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
    const char* position() const { return at_; }

 private:
    void pass_one();

    const char* at_;
    const char* end_;
    std::size_t line_ = 1;
};

// Nothing when the word is not a number from its first to its last character. "nan" and "inf" are numbers here;
// what is too small for a double is zero, what is too large is infinite.
std::optional<double> number(std::string_view word);
std::optional<std::int64_t> integer(std::string_view word);

// Compares letters A-Z without regard to case; `lower` is given in lower case.
bool equals_ignoring_case(std::string_view word, std::string_view lower);

}  // namespace qchopper
