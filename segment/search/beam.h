// The beam of the search: the BSPs (binary space partitions) that are kept from round to round, and their cost.
//
// Invariants: tests/segment/search/beam_test.cpp. Method and reference: search.h.

#pragma once

#include <string>
#include <vector>

#include "segment/search/beam_state.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/rank.h"
#include "segment/search/settings.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// Face ratio and mean undercut of the pieces plus the sums over the cuts of fragility and piece count, all weighted.
double cost(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& cache);

// One BSP of a beam.
struct Bsp {
    Segmentation segmentation;
    std::vector<std::string> passed_over;  // names of pieces that no candidate cuts or no trial makes better
    std::vector<RevertedTrial> reverted;   // of those for which cuts were on trial
    double of_cuts = 0;                    // the part of its cost that later cuts do not change
    NextPiece next;
    std::vector<Ranked> ranked;         // the candidates of its next piece, best first
    std::vector<std::size_t> children;  // indices in `ranked` of those that may expand it
    double cost = 0;

    bool is_live() const { return !next.is_finished && next.piece.has_value(); }
};

// A BSP with its costs. `next`, `ranked` and `children` are left empty.
Bsp bsp(Segmentation segmentation, std::vector<std::string> passed_over, std::vector<RevertedTrial> reverted,
        const Objectives& objectives, EvaluationCache& cache);

// The next round: the cheapest of the ended BSPs and of all children, `settings.beam` at most, cheapest first. A BSP
// none of whose children could be cut stays, with its next piece added to `passed_over`. Where the next piece is on
// trial, a child is a whole trial that begins with its cut (trial.h); no more than `settings.beam` are made of a BSP.
// Precondition: every BSP that is live has children. Throws Cancelled.
std::vector<Bsp> next_round(std::vector<Bsp> beam, const SearchSettings& settings, StopJudge& judge,
                            EvaluationCache& cache, const Context& context);

// The segmentation after each of state.cuts, made from that of the root. Throws InputError (config) if a cut does not
// apply.
std::vector<Segmentation> grow(const BeamState& state, const Segmentation& root, double fragment_volume_mm3);

}  // namespace qchopper
