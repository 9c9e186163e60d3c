// Reports one place of the block in full: the tightest margin of every check with its pose.

#pragma once

#include <vector>

#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/placement/place_score.h"

namespace qchopper {

// All but the remedy and the number of places. `place` is a result of the scorer for all poses, at any score.
MachineReachability reachability_at(const Setup& setup, const Cell& cell,
                                    const std::vector<OrientationPoses>& orientations, PlaceScorer& scorer,
                                    const PlaceScore& place);

}  // namespace qchopper
