// The greedy search as plainly as it can be, for the beam to be held against: evaluations everything anew each time.

#pragma once

#include "segment/search/search.h"

namespace qchopper::greedy {

// Always cuts the next piece by its best candidate until the rules hold or nothing can be cut. Returns whether the
// rules hold.
bool search(Segmentation& segmentation, const SearchSettings& settings);

}  // namespace qchopper::greedy
