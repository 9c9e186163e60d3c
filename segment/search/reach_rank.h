// Ranks the planes of a piece by cost when surface out of reach has a weight: many normals, few of them evaluated
// whole.
//
// The unreachable area of every plane of 132 normals follows from the piece's samples without cutting
// (segment/score/reach_sweep.h). All other terms are at least 0, so normals are taken in the order of the weighted
// least unreachable area, and the others are not evaluated once that alone exceeds the best total: the best plane is
// the one that evaluating all of them would find (tests/segment/search/reach_rank_test.cpp). A side of several solids
// is not judged by the sweep: the best such plane is really cut before it is chosen.

#pragma once

#include <cstddef>
#include <vector>

#include "segment/search/rank.h"

namespace qchopper {

// Whether the settings and the piece's samples ask for this ranking.
bool is_ranked_by_reach(const Piece& piece, const SearchSettings& settings);

// The three axes of the piece's box, then those of the 129 normals of the octahedron that are none of them: what
// Candidate::normal_index counts.
std::vector<Vec3> reach_normals(const OrientedBox& box);

// So many planes that make more than two solids are really cut before the best one is taken as it is.
constexpr int most_real_cuts = 16;

// The planes that were evaluated, best first: the first settings.beam of them are the best of all. Precondition:
// is_ranked_by_reach. Throws Cancelled.
std::vector<Ranked> rank_by_reach(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                                  EvaluationCache& cache, const Context& context);

}  // namespace qchopper
