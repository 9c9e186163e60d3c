// Evaluates many candidates at once, on all cores.
//
// The result is the same to the last bit for any number of threads (tests/segment/score/candidates_test.cpp).

#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/cut/piece.h"
#include "segment/score/candidates.h"
#include "segment/score/cut_evaluation.h"
#include "segment/score/objectives.h"

namespace qchopper {

// One evaluation per candidate, in their order; nothing where the plane misses the piece. Preconditions: the piece is
// closed; the planes are canonical and nudged off its vertices (nudge.h). Candidates of one normal that follow each
// other with ascending offsets share a sweep. `box_axes`: as in prepare(). Reports progress in planes; throws Cancelled
// between sweeps.
std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context,
                                                       const std::array<Vec3, 3>* box_axes = nullptr);

// The values of a piece that is not cut (tests/segment/score/reference_test.cpp). O(triangles * caps).
SolidEvaluation measure(const Piece& piece);

}  // namespace qchopper
