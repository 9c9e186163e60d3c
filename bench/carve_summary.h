// Prints the runs of carve_runs.h as the tables of docs/measurements/out-of-reach.md, and whether the aims hold.

#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace qchopper::bench {

inline const std::vector<std::string> carve_methods{"thesis", "carve 1", "carve 4"};

// One table of shares per tilt; per tilt and beam a table of what carve leaves at equal piece count; and how far
// predictions are from the truth. Runs that are not complete are left out.
void print_carve(const std::filesystem::path& folder, const std::vector<std::string>& models,
                 const std::vector<int>& tilts, std::ostream& out);

}  // namespace qchopper::bench
