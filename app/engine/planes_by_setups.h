// Which planes a piece is cut along of which its setup leaves too much out of reach.
//
// The search ranks planes by what a tool of radius zero without holder reaches. What a setup leaves besides, because
// the tool is too short or the arm holds too few directions, no ranking knows: planes are compared by the setups of the
// pieces that they make (docs/decisions/0039). mm2. The same for any number of threads
// (tests/app/engine/cut_by_setups_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "app/jobs/setups.h"
#include "base/context.h"
#include "segment/search/evaluation_cache.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

// Cuts the piece along the best plane of its ranking, through the middle across the axes of its box, and along two more
// of the ranking that are not near to each other, until no piece of one is above settings.stop.max_unreachable. The
// planes tried come first: those whose pieces all fit the cell, of these by the surface that setups leave of pieces
// above the limit, then by that of all pieces. The other planes of the ranking follow in their order. Precondition:
// max_unreachable is set. Reports progress in planes. Throws Cancelled.
std::vector<Ranked> planes_by_setups(const Segmentation& segmentation, std::size_t piece, std::vector<Ranked> ranked,
                                     const SearchSettings& settings, Setups& setups, EvaluationCache& cache,
                                     const Context& context);

// The pieces that a cut of this piece along the plane would make, made on a copy, with the names that they would get;
// none if it does not part the piece.
std::vector<Piece> pieces_made(const Segmentation& segmentation, std::size_t piece, const Ranked& plane,
                               double fragment_volume_mm3);

}  // namespace qchopper
