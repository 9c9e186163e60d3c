// Reads words, numbers and lines of a text in memory, and counts its lines.
//
// Line ends may be LF, CR LF or CR alone. Numbers do not depend on the locale. Every function is O(characters passed)
// (tests/segment/io/read_mesh_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/files/file.h"

namespace qchopper {

inline std::string_view as_text(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A position in a text, which must outlive it.
class Text {
 public:
    explicit Text(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    // The next run of characters without white space; empty at the end.
    std::string_view word();
    // The rest of the line, without its end; the line end is passed.
    std::string_view rest_of_line();
    // The line of the position, from 1: after word() that of the word.
    std::size_t line() const { return line_; }
    bool at_end() const { return at_ == end_; }
    // Characters from here to the end.
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
    void pass_one();

    const char* at_;
    const char* end_;
    std::size_t line_ = 1;
};

// Nothing if the word is not a number from its first to its last character. A plus sign, "nan" and "inf" are read; a
// value too small for a double is zero, one too large is infinite. integer() returns nothing beyond 64 bits.
std::optional<double> number(std::string_view word);
std::optional<std::int64_t> integer(std::string_view word);

// Compares letters A-Z without regard to case; `lower` is given in lower case.
bool equals_ignoring_case(std::string_view word, std::string_view lower);

}  // namespace qchopper
