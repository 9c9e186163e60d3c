// Reads a list of planes, one in each line: nx,ny,nz,d as --plane takes it.
//
// mm about the scan's centre. Empty lines, and lines that begin with #, are passed over; blanks around numbers too.
// Tests: tests/app/cli/planes_test.cpp.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "segment/mesh/plane.h"

namespace qchopper {

constexpr std::size_t max_planes = 1'000;

// Canonical. Throws InputError (config), with the number of the line: a line that is no plane, no plane at all, more
// than max_planes. Throws also what read_file throws.
std::vector<Plane> planes_of_file(const std::filesystem::path& file);

}  // namespace qchopper
