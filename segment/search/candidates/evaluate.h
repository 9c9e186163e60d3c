// Evaluates many candidates at once, on all cores.
//
// The result is the same to the last bit for any number of threads
// (tests/segment/search/candidates/candidates_test.cpp).

#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/cut/cut_evaluation.h"
#include "segment/cut/piece.h"
#include "segment/objectives/objectives.h"
#include "segment/search/candidates/candidates.h"

namespace qchopper {

// One evaluation per candidate, in their order; nothing where the plane misses the piece. Preconditions: the piece is
// closed; the planes are canonical and nudged off its vertices (nudge.h). Candidates of one normal that follow each
// other with ascending offsets share a sweep. `box_axes`: as in prepare(). Reports progress in planes; throws Cancelled
// between sweeps.
std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context,
                                                       const std::array<Vec3, 3>* box_axes = nullptr);

// Candidates [first, last) share a normal; their offsets ascend.
struct CandidateGroup {
    std::size_t first;
    std::size_t last;
};
// All of the candidates, in their order.
std::vector<CandidateGroup> groups_of(std::span<const Candidate> candidates);

// The values of a piece that is not cut (tests/segment/objectives/sweep/reference_test.cpp). O(triangles * caps).
SolidEvaluation measure(const Piece& piece);

}  // namespace qchopper
