// Sentences as the command line says them: with its commands and options, by a table of their keys.
//
// Tests: tests/app/report/command_line_text_test.cpp, tests/architecture/options_test.py.

#pragma once

#include <string>
#include <vector>

#include "base/sentence.h"

namespace qchopper {

// The row of the table for the sentence's key, completed by its values, which are worded in the same way; without a
// key the text. Precondition: the table has a row for the key, and the sentence a value for each place of the row.
std::string command_line_text(const Sentence& sentence);
std::vector<std::string> command_line_text(const std::vector<Sentence>& sentences);

}  // namespace qchopper
