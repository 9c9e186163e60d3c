// Proposes the planes by which a piece that is too large is cut for size: docs/decisions/0024.
//
// Offsets as in candidates.h, along the three axes, before their nudge. Tests: tests/segment/search/size_cut_test.cpp.

#pragma once

#include <cstddef>
#include <set>
#include <utility>

#include "segment/mesh/oriented_box.h"
#include "segment/search/candidates/candidates.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// The candidates of a piece that is too large, by normal and offset: the planes along the axes of its box that leave
// two boxes which need the fewest blocks together. A box that needs one block only, though the piece does not fit, is
// cut across its length within the middle half. None: no number of blocks is enough. O(offsets).
std::set<std::pair<std::size_t, std::size_t>> candidates_for_size(const OrientedBox& box,
                                                                  const CandidateOptions& options,
                                                                  const BlocksNeeded& too_large_for);

}  // namespace qchopper
