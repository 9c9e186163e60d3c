// Chooses cuts until the stop rules hold: a beam search over BSPs (Nicholson 2016, chapters 3 and 4).
//
// Each round expands each of the b best BSPs by the best candidates of its next piece and keeps the b best by one
// cost: face ratio and mean undercut of the pieces plus fragility and piece count summed over the cuts, all weighted.
// b = 1 is the greedy search, decision by decision. What is known of a child before it is kept comes from the
// evaluation of its candidate; only a BSP that is kept is really cut. A wider beam keeps the cheapest it has seen,
// which is not always cheaper at the end; one as wide as all candidates is, of two cuts
// (tests/segment/search/beam_test.cpp).

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/search/beam_state.h"
#include "segment/search/end_reason.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/rank.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

struct SearchEnd {
    EndReason reason = EndReason::rules_hold;
    std::string sentence;  // describe(reason) with its figure
    double cost = 0;
    bool is_finished() const { return qchopper::is_finished(reason); }
    bool is_out_of_time() const { return reason == EndReason::time_limit; }
};

// Where a search with b > 1 stands. It goes on from `state` if that has branches; `root` is then the segmentation that
// they grow from. After every round `state` is the beam as it is now. At b = 1 the segmentation says it all.
struct BeamProgress {
    BeamState state;
    Segmentation root;
    // To be saved; nothing where no beam is kept.
    std::optional<BeamState> saved() const { return state.branches.empty() ? std::nullopt : std::optional(state); }
};

// Goes on from where the segmentation stands, and leaves the best BSP there. `on_round` is told the best so far after
// every round that changes it, so that it can be saved: at b = 1 that is every decision. After `time_limit_s` it stops
// with the round that is being made. Throws Cancelled when asked to stop; the best of the last round stands then.
// Interrupted anywhere and gone on with from `progress`, it ends as if it had not been interrupted
// (tests/app/project/open_project_test.cpp).
SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, EvaluationCache& book,
                 const FitsCell& fits_cell, const std::function<void(const Segmentation&)>& on_round,
                 const Context& context, std::optional<double> time_limit_s = std::nullopt,
                 BeamProgress* progress = nullptr);

}  // namespace qchopper
