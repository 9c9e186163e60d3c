// Chooses cuts until the stop rules hold: a beam search over BSPs (Nicholson 2016, chapters 3 and 4).
//
// Each round expands each of the b best BSPs by the best candidates of its next piece and keeps the b best by one
// cost: face ratio and mean undercut of the pieces plus fragility and piece count summed over the cuts, all weighted.
// b = 1 is the greedy search, decision by decision. The cost of a child follows from the evaluation of its candidate;
// only a BSP that is kept is cut. A wider beam does not always end cheaper; one as wide as all candidates finds the
// cheapest two cuts (tests/segment/search/beam_test.cpp). On beam search over BSPs: Luo et al. 2012.
//
// With the rule max_unreachable, a piece that breaks no other rule is cut on trial: up to three cuts of it and of what
// they leave are kept if they make it better, else reverted, and the piece is passed over (trial.h). A whole trial is
// one decision of one round: no state within it is reported or saved, and a time limit that passes in it ends the
// search after it. With b > 1 every branch has trials of its own, one for each of its b best first cuts.

#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/search/beam_state.h"
#include "segment/search/end_reason.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/rank_piece.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

struct SearchEnd {
    EndReason reason = EndReason::rules_hold;
    std::string sentence;  // describe(reason) with its figure
    double cost = 0;
    std::vector<RevertedTrial> reverted = {};  // of the pieces that are left
    bool is_finished() const { return qchopper::is_finished(reason); }
    bool is_out_of_time() const { return reason == EndReason::time_limit; }
};

// Several searches of one command share one limit: its start is that of the first.
struct TimeLimit {
    double seconds = 0;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    bool has_passed() const;
};

// The end of a search that a limit which has passed keeps from its first round.
SearchEnd end_of_time(const TimeLimit& limit);

// The progress of a search that has a state beside its segmentation (SearchSettings::has_state). If `state` has
// branches the search resumes from it, and `root` is the segmentation that the branches start from. After every round
// `state` is the present beam. At b = 1 its one branch has no cuts but those of the root, which is the segmentation
// itself; it carries the pieces that are passed over. Otherwise the segmentation is enough, and `state` stays as it is.
struct BeamProgress {
    BeamState state;
    Segmentation root;
    // The state to save; nothing if there is no beam.
    std::optional<BeamState> saved() const { return state.branches.empty() ? std::nullopt : std::optional(state); }
};

// What decides whether a search is finished and which piece is cut next: by faces, or where surface out of reach has a
// weight, by that surface. Both references must outlive it.
StopJudge judge_for(const SearchSettings& settings, const PieceChecks& checks, EvaluationCache& cache);

// Continues from the cuts of `segmentation` and returns the best BSP in it. `on_round` is called with the best so far
// after every round that changes it, so that it can be saved: at b = 1 after every decision. The search ends with the
// round in which `time_limit` passes; at least one round is made unless the limit is 0. Throws Cancelled if the
// context is cancelled; `segmentation` is then the best of the last round. A search that is interrupted anywhere and
// resumed from `progress` ends as if it had not been interrupted (tests/app/engine/open_project_test.cpp). `progress`
// may be null.
SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, EvaluationCache& cache,
                 const PieceChecks& checks, const std::function<void(const Segmentation&)>& on_round,
                 const Context& context, const std::optional<TimeLimit>& time_limit = std::nullopt,
                 BeamProgress* progress = nullptr);

}  // namespace qchopper
