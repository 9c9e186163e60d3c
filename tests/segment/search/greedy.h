// The reference of the beam search: the greedy search, as plain as possible. Evaluates everything again for each cut.

#pragma once

#include "segment/search/search.h"

namespace qchopper::greedy {

// Always cuts the next piece by its best candidate until the rules hold or nothing can be cut. Returns whether the
// rules hold.
bool search(Segmentation& segmentation, const SearchSettings& settings);

}  // namespace qchopper::greedy
