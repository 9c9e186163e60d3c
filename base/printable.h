// Text from outside, from a cell or a file, as a terminal may show it.

#pragma once

#include <string>
#include <string_view>

namespace qchopper {

// With \xNN in place of each byte of control characters (C0, DEL, C1), of characters that change the direction of
// writing or end a line, and of what is no UTF-8. Without such characters the text itself
// (tests/base/printable_test.cpp). O(bytes).
std::string printable(std::string_view text);

// The same, line by line: line feeds stay.
std::string printable_lines(std::string_view text);

}  // namespace qchopper
