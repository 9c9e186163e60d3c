// Reports one place of the block in full: the tightest margin of every check with its pose.

#pragma once

#include <vector>

#include "cam/setup/placement/place_score.h"
#include "cam/setup/placement/work_envelope.h"

namespace qchopper {

// All but the cure and the number of places. `place` is a result of the scorer for all poses, at any score.
WorkEnvelope envelope_at(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions,
                         PlaceScorer& scorer, const PlaceScore& place);

}  // namespace qchopper
