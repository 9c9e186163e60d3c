// Puts the candidates of one piece in order: best first, by the weights that stand now.
//
// Ranking never cuts: it weighs ingredients that are known (evaluation_cache.h), or that the book finds out first. Ties
// within 1e-9 of the total go to the lower normal, then offset (tests/segment/search/search_test.cpp).

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

// What the other pieces of the segmentation bring into the objectives.
std::vector<PieceShare> shares_of_others(const Segmentation& segmentation, std::size_t piece,
                                         const Objectives& objectives, EvaluationCache& book);

std::vector<Ranked> rank(const PieceEvaluations& evaluations, std::span<const PieceShare> others,
                         const Objectives& objectives);

// Which of a ranking stay when every candidate is dropped that has a better one of the same normal less than `near` of
// the piece's extent away. Indices, best first.
std::vector<std::size_t> without_near_duplicates(const std::vector<Ranked>& ranked, int offsets_per_normal,
                                                 double near);

// All candidates of one piece, best first.
std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         EvaluationCache& book, const Context& context);

// One plane that is no candidate of the piece. Nothing if it misses, or leaves fewer than two pieces that are no
// fragments.
std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, EvaluationCache& book, const Context& context);

// The cut that takes the k-th of a ranking (from 0), with the next best beside it; its number follows the others'.
Cut cut_by(const Segmentation& segmentation, std::size_t piece, const std::vector<Ranked>& ranked, std::size_t k,
           std::size_t runners_up);

}  // namespace qchopper
