// Chooses cuts until the stop rules hold: a beam search over BSPs (Nicholson 2016, chapters 3 and 4).
//
// Each round expands each of the b best BSPs by the best candidates of its next piece and keeps the b best by one
// cost: face ratio and mean undercut of the pieces plus fragility and piece count summed over the cuts, all weighted.
// b = 1 is the greedy search, decision by decision. What is known of a child before it is kept comes from the price
// of its candidate; only a BSP that is kept is really cut. A wider beam keeps the cheapest it has seen, which is not
// always cheaper at the end; one as wide as all candidates is, of two cuts (tests/segment/search/beam_test.cpp).

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/search/beam_state.h"
#include "segment/search/end_reason.h"
#include "segment/search/piece_book.h"
#include "segment/search/rank.h"
#include "segment/search/segmentation.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct SearchSettings {
    Objectives objectives;
    CandidateOptions candidates;
    StopRules stop;
    std::size_t runners_up = 9;  // how many are kept beside the chosen one
    std::size_t beam = 1;        // b: how many BSPs are kept per round
    double near = 0.06;          // of two candidates of one parent with one normal and offsets nearer than this share
                                 // of the piece's extent, the worse is culled; of no effect at b = 1
    bool operator==(const SearchSettings&) const = default;
};

// All candidates of one piece, best first.
std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         PieceBook& book, const Context& context);

// One plane that is no candidate of the piece. Nothing if it misses, or leaves fewer than two pieces that are no
// crumbs.
std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, PieceBook& book, const Context& context);

// The cut that takes the k-th of a ranking (from 0), with the next best beside it; its number follows the others'.
Cut cut_by(const Segmentation& segmentation, std::size_t piece, const std::vector<Ranked>& ranked, std::size_t k,
           std::size_t runners_up);

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
SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, PieceBook& book, const FitsCell& fits_cell,
                 const std::function<void(const Segmentation&)>& on_round, const Context& context,
                 std::optional<double> time_limit_s = std::nullopt, BeamProgress* progress = nullptr);

}  // namespace qchopper
