// How many letters apart two words are.

#pragma once

#include <cstddef>
#include <string_view>

namespace qchopper {

// The least number of letters inserted, deleted or replaced that makes `b` of `a` (V. I. Levenshtein, "Binary codes
// capable of correcting deletions, insertions, and reversals", 1966). O(a.size() * b.size()).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace qchopper
