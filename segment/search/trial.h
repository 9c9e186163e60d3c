// Cuts a piece on trial: its cuts are kept if they make enough of its surface reachable.
//
// mm2. Cuts make a piece better if, within three cuts of it and its descendants, their unreachable area falls by at
// least 10 % of the piece's, by 0.2 % of the piece's area, by what the finest tool can tell from nothing
// (PieceChecks::min_gain_mm2), and by the strip along their joints that is finished by hand (seam_width_mm); or if
// every piece holds the rules then, it falls by a quarter of what the finest tool can tell, and few pieces of the
// segmentation break a rule (StopJudge::do_few_break_rules): for the last ones, so that all hold, and not for one in
// two of a hundred. One cut may gain nothing. Every cut made is real: nothing is estimated. On what was chosen:
// docs/decisions/0020-cuts-on-trial-are-one-decision.md. Tests: tests/segment/search/trial_test.cpp.

#pragma once

#include <optional>
#include <string>

#include "base/context.h"
#include "segment/search/beam_state.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

constexpr int trial_cuts = 3;

// By how much the unreachable area of a piece must fall at least, if `before_mm2` is out of reach now and not every
// piece holds the rules then. O(triangles).
double min_fall_mm2(const Piece& piece, double before_mm2, double min_gain_mm2);

// The same if every piece holds the rules then. A piece of which less is out of reach is not cut on trial at all.
constexpr double least_fall_to_hold_mm2(double min_gain_mm2) {
    return min_gain_mm2 / 4;
}

struct Trial {
    std::optional<Segmentation> better;  // with the cuts until the first that was enough
    RevertedTrial reverted;              // if there is no such
};

// Makes the cut `first`, then up to two more: always of the piece with the largest unreachable area, of those that the
// trial made and that break a rule, by its best candidate (StopJudge::planes_on_trial); a piece without candidates is
// left. Ends before max_cuts is exceeded. Returns nothing if `first` does not apply. Precondition: the judge's rule
// max_unreachable is in force. Throws Cancelled.
std::optional<Trial> try_cuts(const Segmentation& segmentation, const Cut& first, const SearchSettings& settings,
                              StopJudge& judge, EvaluationCache& cache, const Context& context);

// "three cuts changed that from 812 to 790 cm2"
std::string describe(const RevertedTrial& trial);

}  // namespace qchopper
