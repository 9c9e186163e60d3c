// Ranks the candidates of one piece by weighted cost, best first.
//
// Ranking never cuts: it weighs evaluations that are in the cache (evaluation_cache.h) or are computed for it. Ties
// within 1e-9 of the total go to the lower normal_index, then offset_index (tests/segment/search/search_test.cpp). In
// all functions `piece` is an index in Segmentation::pieces.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

constexpr double tie = 1e-9;  // totals that differ by less are equal

// The values of the other pieces of the segmentation, in their order.
std::vector<PieceShare> shares_of_others(const Segmentation& segmentation, std::size_t piece,
                                         const Objectives& objectives, EvaluationCache& cache);

// What the uncut scan and the older cuts add to the terms of a cut of the piece. Precondition: the scan is measured
// where objectives need it.
ScanShare scan_share(const Segmentation& segmentation, std::size_t piece, const Objectives& objectives,
                     EvaluationCache& cache);

// One candidate; nothing if it misses or has no terms (objectives.h). `others`: the shares of the other pieces.
std::optional<Ranked> rank(const Candidate& candidate, const std::optional<CutEvaluation>& evaluation,
                           std::span<const PieceShare> others, const Objectives& objectives, const ScanShare& scan);

// The candidates that have terms, best first; those that are forbidden after all others.
std::vector<Ranked> rank(const PieceEvaluations& evaluations, std::span<const PieceShare> others,
                         const Objectives& objectives, const ScanShare& scan = {});

// The same of the planes that are evaluated whole.
std::vector<Ranked> rank(std::span<const PlanesOfNormal> planes, std::span<const PieceShare> others,
                         const Objectives& objectives, const ScanShare& scan);

// Sorts by the totals as they are; what is forbidden comes last.
void sort_ranking(std::vector<Ranked>& ranked, const Objectives& objectives);

// Drops from a ranking every candidate that has a better one of the same normal_index at a distance below `near`, a
// share of the piece's extent. Returns the indices of the others, best first.
std::vector<std::size_t> without_near_duplicates(const std::vector<Ranked>& ranked, int offsets_per_normal,
                                                 double near);

// Drops from a ranking every plane that is nowhere in the piece further than one step of the offsets from a better one:
// what an operator is shown, and what a cut records beside its plane. Returns the indices of the first `most` of the
// others, best first. A plane along one of the candidates' normals has two neighbours at most. O(planes x planes that
// are kept + points x planes that are kept).
std::vector<std::size_t> without_neighbours(const std::vector<Ranked>& ranked, const Piece& piece,
                                            const CandidateOptions& options, std::size_t most);

// The cut by the k-th of a ranking (from 0), with up to settings.runners_up of the others (without_neighbours). Its
// number follows those of the cuts that are made. Precondition: k < ranked.size().
Cut cut_by(const Segmentation& segmentation, std::size_t piece, const std::vector<Ranked>& ranked, std::size_t k,
           const SearchSettings& settings);

}  // namespace qchopper
