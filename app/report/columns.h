// Formats for lines of reports: a table with even columns, a point or direction.

#pragma once

#include <string>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// One line per row, columns left-aligned and two spaces apart; rows may have different lengths. Widths are counted in
// bytes. O(characters).
std::vector<std::string> columns(const std::vector<std::vector<std::string>>& rows);

// "(0.000, 0.600, 0.800)"
std::string in_brackets(Vec3 v, int decimals);

}  // namespace qchopper
