// The score of one place, without a search.

#include "tests/reference/cam/setup/holds_at_placement.h"

#include "cam/setup/block_placement.h"
#include "cam/setup/placement/place_score.h"

namespace qchopper {

bool holds_at_placement(const Setup& setup, const std::vector<OrientationPoses>& orientations, const Cell& cell) {
    constexpr double rounding = 1e-9;  // of scores
    if (inside_table(cell, setup.block.size, setup.placement) < -rounding) return false;
    PlaceScorer scorer(setup, cell, orientations);
    scorer.given_angles(setup.placement.table_angles.size() == orientations.size());
    return scorer.judged(setup.placement, {true, 0, {}, 0}).score >= -rounding;
}

}  // namespace qchopper
