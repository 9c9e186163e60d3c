// Text from outside, from a cell or a file, as a terminal or a shell may get it.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace qchopper {

struct Utf8Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  // 0: no well-formed sequence begins there
};
// The sequence at the beginning of `text`, which is not empty.
Utf8Character first_character(std::string_view text);

// With \xNN in place of each byte of control characters (C0, DEL, C1), of characters that change the direction of
// writing or end a line, and of what is no UTF-8. Without such characters the text itself
// (tests/base/printable_test.cpp). O(bytes).
std::string printable(std::string_view text);

// The same, line by line: line feeds stay.
std::string printable_lines(std::string_view text);

// A path quoted for a POSIX shell, for the commands that are printed for the operator: the path itself if it has
// letters, digits and harmless marks only, else in single quotes. The shell reads it as one word, and no program as an
// option (tests/base/shell_word_test.cpp). O(characters).
std::string shell_word(const std::filesystem::path& path);

}  // namespace qchopper
