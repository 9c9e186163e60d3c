// What of a piece is out of reach of a tilting tool, for the stop rule max_unreachable: on samples of the piece, from
// the base that leaves least out of reach, along at most eight directions (segment/access/piece_access.h).
//
// mm2. The same piece gives the same bytes for any number of threads.

#pragma once

#include <optional>

#include "segment/search/stop_rules.h"

namespace qchopper {

// `tilt_deg`: the largest tilt of the tool axis from the vertical, degrees.
UnreachableOf unreachable_of(double tilt_deg);

// The share of a piece's surface without its base that is out of reach along all directions within the tilt, from the
// base that leaves least: what the objective `unreachable` sums, on the samples that the search has of the piece. Not
// that of the stop rule above, which takes at most eight directions. Nothing for a piece without samples.
std::optional<double> share_by_objective(const Piece& piece, double tilt_deg);

}  // namespace qchopper
