// The edit distance of two words, to find the known name nearest to a misspelt one (tests/base/text_test.cpp).

#pragma once

#include <cstddef>
#include <string_view>

namespace qchopper {

// The least number of bytes inserted, deleted or replaced that turns `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace qchopper
