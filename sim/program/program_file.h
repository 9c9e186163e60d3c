// Files of programs cut into lines, with what no language allows refused.

#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

// Lines without their ends. Refused by refuse_line(), with the line: a character outside of 32..126, a line that does
// not end with CR LF or is longer than 400 characters. The file must outlive the result. O(bytes).
std::vector<std::string_view> program_lines_of(const ProgramFile& file);

// A letter, then letters, digits and _, all in lower case.
bool is_program_name(std::string_view stem, std::size_t longest);

}  // namespace qchopper
