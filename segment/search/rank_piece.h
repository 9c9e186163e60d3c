// Ranks the planes of one piece of a segmentation: those along its normals (rank.h), or where surface out of reach has
// a weight the best of them (access_rank.h), and further ones (further_candidates.h).
//
// Ties and preconditions as in rank.h (tests/segment/search/search_test.cpp, access_rank_test.cpp beside it).

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "segment/search/rank.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// All candidates of one piece, best first, evaluated if they are not in the cache. Where the normals are set to those
// of the sphere, the best plane of a normal is refined: a finer offset beside it that costs less stands before it.
// Throws Cancelled. Of a piece that is ranked by reach at least max(settings.beam, best) of them (access_rank.h).
// `too_large_for`: of a piece that is cut for size, StopJudge::too_large_for(); of no effect where surface out of reach
// has no weight.
std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         EvaluationCache& cache, const Context& context, std::size_t best = 1,
                         const BlocksNeeded& too_large_for = {});

// The same, of a piece that is ranked by reach with all planes of three normals, those of the best planes, and of the
// normal with the index `other`, so that they can be plotted.
std::vector<Ranked> rank_whole_normals(const Segmentation& segmentation, std::size_t piece,
                                       const SearchSettings& settings, EvaluationCache& cache, const Context& context,
                                       int other, const BlocksNeeded& too_large_for = {});

// The terms of one plane that is no candidate of the piece. Nothing if it misses, or leaves fewer than two pieces,
// fragments not counted. Throws Cancelled.
std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, EvaluationCache& cache, const Context& context);

}  // namespace qchopper
