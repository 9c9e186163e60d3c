// Ranks the planes of a piece by cost when surface out of reach has a weight: many normals, few of their planes
// evaluated whole.
//
// The unreachable area of every plane of 132 normals follows from the piece's samples without cutting
// (segment/access/access_sweep.h). All other terms are at least 0, so a plane is not evaluated once its weighted
// unreachable area alone exceeds the best total: the best plane is the one that evaluating all candidates would find
// (tests/segment/search/access_rank_test.cpp). A side of several solids is not judged by the sweep: such planes are
// really cut if they come to stand among the first four. The best plane is moved and turned a little
// (refined_plane.h), and the plane found stands where its total puts it, on the same samples as all others. On the
// order and the candidates: docs/decisions/0022;
// of pieces that are too large: docs/decisions/0024.

#pragma once

#include <cstddef>
#include <vector>

#include "segment/search/rank.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// Whether the settings and the piece's samples ask for this ranking.
bool is_ranked_by_access(const Piece& piece, const SearchSettings& settings);

// Candidates are the planes that open at least this share of the surface that the best one opens: further terms decide
// between planes that serve nearly as well. Where no plane opens this share of the scan's area, only the axes of the
// piece's box have candidates.
constexpr double min_share_of_gain = 0.85;
constexpr double min_gain_of_scan = 0.0002;

// So many planes are certain to be the best, if neither the beam nor what is asked for is more.
constexpr std::size_t min_best_planes = 4;

// So many planes that make more than two solids are really cut before the best one is taken as it is.
constexpr int max_real_cuts = 16;

// The planes that were evaluated, best first: the first max(settings.beam, best) of them are the best of all
// candidates. `too_large_for`: as in rank_piece.h. Precondition: is_ranked_by_access. Throws Cancelled.
std::vector<Ranked> rank_by_access(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                                   EvaluationCache& cache, const Context& context, std::size_t best = min_best_planes,
                                   const BlocksNeeded& too_large_for = {});

// The same, and with them all planes of so many normals, those of the best planes, and of the normal with the index
// `other` (none: -1), candidates or not.
std::vector<Ranked> rank_whole_normals_by_access(const Segmentation& segmentation, std::size_t piece,
                                                 const SearchSettings& settings, EvaluationCache& cache,
                                                 const Context& context, std::size_t normals, int other,
                                                 const BlocksNeeded& too_large_for = {});

}  // namespace qchopper
