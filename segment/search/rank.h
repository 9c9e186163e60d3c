// Puts the candidates of one piece in order: best first, by the weights that stand now.
//
// Ranking never cuts and never prices: it weighs ingredients that are known (piece_book.h). Ties within 1e-9 of the
// total go to the lower normal, then offset (tests/segment/search/search_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "segment/search/piece_book.h"
#include "segment/search/segmentation.h"

namespace qchopper {

constexpr double tie = 1e-9;  // totals that differ by less are equal

// What the other pieces of the segmentation bring into the objectives.
std::vector<PieceShare> shares_of_others(const Segmentation& segmentation, std::size_t piece,
                                         const Objectives& objectives, PieceBook& book);

std::vector<Ranked> rank(const PiecePrices& prices, std::span<const PieceShare> others, const Objectives& objectives);

// Which of a ranking stay when every candidate is dropped that has a better one of the same normal less than `near` of
// the piece's extent away. Indices, best first.
std::vector<std::size_t> without_near_duplicates(const std::vector<Ranked>& ranked, int offsets_per_normal,
                                                 double near);

}  // namespace qchopper
