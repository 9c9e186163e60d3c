// What a list of cuts says of itself, and what becomes of it when one of its cuts is replaced.
//
// Tests: tests/segment/search/recut_test.cpp.

#pragma once

#include <cstdint>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

// Whether nothing was cut of what the cut made. Precondition: 1 <= number <= cuts.size().
bool is_last_of_its_pieces(const std::vector<Cut>& cuts, std::int32_t number);

// Whether `by` can be put in the place of the cut with its number: there is one, it is of the same piece and the last
// of its pieces, `by` makes a piece, and the names of its pieces begin as those of the other.
bool can_replace(const std::vector<Cut>& cuts, const Cut& by);

// Puts `by` in the place of the cut with its number. The cuts after it are of other pieces and stay the same, but
// where `by` makes more or fewer pieces, all pieces that they make get other names: those that apply() gives.
// Precondition: can_replace(cuts, by). O(cuts log cuts).
void replace_cut(std::vector<Cut>& cuts, const Cut& by);

}  // namespace qchopper
