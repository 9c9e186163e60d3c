// What prepare tells at its end: warnings and a table for people, one JSON document for programs.

#pragma once

#include <string>
#include <vector>

#include "app/project/open_project.h"

namespace qchopper {

// Of pieces that do not fit.
std::vector<std::string> warnings(const PreparedProject& prepared);
std::vector<std::string> table(const PreparedProject& prepared, const Cell& cell);
std::string document(const PreparedProject& prepared, const Cell& cell);

}  // namespace qchopper
