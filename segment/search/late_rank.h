// Ranks the candidates of a piece by cost where terms have a weight that are slow to evaluate: fragility by rays,
// connector, symmetry.
//
// No term is negative, so the cost without the slow terms is a bound. Normals are taken in the order of their least
// bound, a few at a time; of those of their planes that can be among the best fragility is evaluated first, then the
// other slow terms. It ends when no other plane can be, so that the best are the same as if all were evaluated
// (tests/segment/search/late_rank_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/search/rank.h"

namespace qchopper {

// Whether the settings ask for this ranking: connector or symmetry has a weight.
bool is_ranked_late(const SearchSettings& settings);

// The first `best` of all candidates, and others of the same cost as the last of them; fewer if there are fewer. Which
// these are does not depend on what was evaluated before. Throws Cancelled.
std::vector<Ranked> rank_late(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                              EvaluationCache& cache, const Context& context, std::size_t best);

// So many of the best candidates are ranked again with the oriented box of each part that they would make.
constexpr std::size_t max_own_boxes = 16;

// Puts the first planes of a ranking in the order of their cost with own boxes, where parts, utilization or seam count
// them: candidates are evaluated along the axes of the piece's box. These planes are really cut. Throws Cancelled.
std::vector<Ranked> with_own_boxes(std::vector<Ranked> ranked, const Segmentation& segmentation, std::size_t piece,
                                   const Objectives& objectives, EvaluationCache& cache, const Context& context);

}  // namespace qchopper
