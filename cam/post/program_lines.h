// Lines of a program in any language, and the numbers in them.
//
// Numbers have a point and a fixed number of decimals, under every locale: never an exponent, never "-0.00", and what
// is not finite or out of range is refused (tests/cam/post/krl_text_test.cpp). Lines end with CR LF.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/vec3.h"

namespace qchopper {

// A file of a program.
struct ProgramText {
    std::string name;  // "qc_7_001.src", with the ending of its language
    std::string text;
    bool operator==(const ProgramText&) const = default;
};

// Lines of a file and how many there are.
class ProgramLines {
 public:
    // What stands before and behind a comment.
    explicit ProgramLines(std::string_view comment_begin, std::string_view comment_end = {})
        : comment_begin_(comment_begin), comment_end_(comment_end) {}

    void line(std::string_view text);
    // A comment; what is not printable ASCII becomes _.
    void comment(std::string_view text);
    void append(const ProgramLines& other);

    const std::string& bytes() const { return bytes_; }
    std::size_t lines() const { return lines_; }

 private:
    std::string_view comment_begin_;
    std::string_view comment_end_;
    std::string bytes_;
    std::size_t lines_ = 0;
};

// What is not printable ASCII becomes _.
std::string as_ascii(std::string_view text);

// With so many decimals, rounded half away from zero. Throws InputError (use) that names what is not finite or not
// below `largest` in size.
std::string written_number(std::string_view what, double value, int decimals, double largest);

// A coordinate in mm, below 5 m in size; two decimals unless stated.
std::string written_mm(std::string_view what, double value, int decimals = 2);

}  // namespace qchopper
