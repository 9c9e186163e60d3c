// Rows of words as a table with even columns; the first row is the head.

#pragma once

#include <string>
#include <vector>

namespace qchopper {

std::vector<std::string> columns(const std::vector<std::vector<std::string>>& rows);

}  // namespace qchopper
