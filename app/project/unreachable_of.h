// What of a piece is out of reach of a tilting tool, for the stop rule max_unreachable: on samples of the piece, from
// the base that leaves least out of reach, along at most eight directions (segment/score/piece_reach.h).
//
// mm2. The same piece gives the same bytes for any number of threads.

#pragma once

#include "segment/search/stop_rules.h"

namespace qchopper {

// `tilt_deg`: the largest tilt of the tool axis from the vertical, degrees.
UnreachableOf unreachable_of(double tilt_deg);

}  // namespace qchopper
