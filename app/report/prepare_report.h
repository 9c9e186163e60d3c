// The result of prepare: warnings and a table for people, one JSON document for programs. O(cuts + pieces).

#pragma once

#include <string>
#include <vector>

#include "app/engine/open_project.h"

namespace qchopper {

// Of pieces that do not fit, or of which more is out of reach than may be, and of programs (program_report.h).
std::vector<std::string> warnings(const PreparedProject& prepared);
// A row per piece, then the fragments, the discarded pieces and the next command.
std::vector<std::string> table(const PreparedProject& prepared);
// The document qchopper-prepare-5 (tests/app/cli/json_test.cpp).
std::string document(const PreparedProject& prepared);

}  // namespace qchopper
