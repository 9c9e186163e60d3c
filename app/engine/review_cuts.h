// Judges the cuts of a search by the setups of their pieces, and tries other planes where these are worse than the
// search expected.
//
// The search takes a tool of radius zero without holder and all directions; a setup has few directions, a holder and
// an arm. Which cuts are asked and what is tried: docs/decisions/0023-setups-judge-the-cuts.md. mm2. The same for any
// number of threads (tests/app/engine/review_cuts_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/jobs/setups.h"
#include "app/store/cut_review.h"
#include "base/context.h"
#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

// By so much more of a piece must be out of reach of its setup than of as many directions without holder.
constexpr double doubtful_share = 0.02;
// So many other planes of a cut are tried.
constexpr std::size_t tried_planes = 3;

// Ascending numbers of the cuts that made a piece whose setup leaves more than doubtful_share more of it out of reach
// than the objective with as many directions, on samples and without holder. Computes all setups. Reports progress in
// pieces. Throws Cancelled.
std::vector<std::int32_t> doubtful_cuts(const Segmentation& segmentation, Setups& setups, const Context& context);

// The pieces of one cut, by their setups.
MilledSurface milled_surface(const Segmentation& segmentation, std::int32_t cut, Setups& setups);

struct RecutTrial {
    CutReview review;
    std::optional<Segmentation> better;  // the cut alone (segment/search/recut.h), if the verdict is `replaced`
};

// Cuts `divided`, the piece that the cut divides, along its first runners-up, and takes the plane of which the pieces
// leave least out of reach by their setups, if this is less by 0.2 % of the area of `divided` at least (and by
// Setups::min_gain_mm2) and the pieces hold the rules on faces, box and cell that those of the cut hold now.
// Precondition: is_last_of_its_pieces(cuts, number) and the cut makes a piece. Reports progress in planes. Throws
// Cancelled.
RecutTrial try_other_planes(const Segmentation& segmentation, const Piece& divided, std::int32_t number,
                            const SearchSettings& settings, Setups& setups, const Context& context);

}  // namespace qchopper
