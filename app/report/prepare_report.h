// The result of prepare: warnings and a table for people, one JSON document for programs. O(cuts + pieces).

#pragma once

#include <string>
#include <vector>

#include "app/engine/open_project.h"
#include "app/report/document.h"

namespace qchopper {

// Of pieces that do not fit, or of which more is out of reach than may be, and of programs (program_report.h).
std::vector<std::string> warnings(const PreparedProject& prepared);
// A row per piece, then the fragments, the discarded pieces and the next command.
std::vector<std::string> table(const PreparedProject& prepared);
inline constexpr const char* prepare_schema = "qchopper-prepare-5";
// Of this schema (tests/app/cli/json_test.cpp).
Document document(const PreparedProject& prepared);

}  // namespace qchopper
