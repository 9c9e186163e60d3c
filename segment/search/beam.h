// The beam: the BSPs that are kept from round to round, and their cost.

#pragma once

#include <string>
#include <vector>

#include "segment/search/beam_state.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/rank.h"
#include "segment/search/settings.h"

namespace qchopper {

// Face ratio and mean undercut of the pieces plus the sums over the cuts of fragility and piece count, weighted.
double cost(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& book);

// One of the BSPs of a beam.
struct Bsp {
    Segmentation segmentation;
    std::vector<std::string> passed_over;  // pieces that no candidate parts
    double of_cuts = 0;                    // what its cuts add to its cost whatever follows
    NextPiece next;
    std::vector<Ranked> ranked;         // the candidates of its next piece, best first
    std::vector<std::size_t> children;  // those of them that it may be expanded by
    double cost = 0;

    bool is_live() const { return !next.is_finished && next.piece.has_value(); }
};

Bsp bsp(Segmentation segmentation, std::vector<std::string> passed_over, const Objectives& objectives,
        EvaluationCache& book);

// The next round: the cheapest of what ended and of all children, `settings.beam` at most, cheapest first.
std::vector<Bsp> next_round(std::vector<Bsp> beam, const SearchSettings& settings, EvaluationCache& book);

// The segmentation after each of state.cuts, from that of the root. Throws InputError (config) if a cut does not apply.
std::vector<Segmentation> grow(const BeamState& state, const Segmentation& root, double fragment_volume_mm3);

}  // namespace qchopper
