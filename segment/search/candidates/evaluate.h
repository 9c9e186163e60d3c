// Evaluates many candidates at once, on all cores.
//
// The result is the same to the last bit for any number of threads
// (tests/segment/search/candidates/candidates_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/cut/cut_evaluation.h"
#include "segment/cut/piece.h"
#include "segment/objectives/objectives.h"
#include "segment/objectives/sweep/prepared.h"
#include "segment/search/candidates/candidates.h"

namespace qchopper {

// One evaluation per candidate, in their order; nothing where the plane misses the piece. Preconditions: the piece is
// closed; the planes are canonical and nudged off its vertices (nudge.h). Candidates of one normal that follow each
// other with ascending offsets share a sweep. `box_axes`: as in prepare(). Reports progress in planes; throws Cancelled
// between sweeps.
std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context,
                                                       const std::array<Vec3, 3>* box_axes = nullptr);

// The values of a piece that is not cut (tests/segment/objectives/sweep/reference_test.cpp). O(triangles * caps).
SolidEvaluation measure(const Piece& piece);

// --- One normal, in stages: the cheap terms first, so that the slow ones can wait until a plane may still be among the
// best (best_first.h).

// Each stage holds the terms of those before it. Those that are not evaluated are 0, and no term is negative.
enum class TermStage : std::uint8_t { none, solids, fragility, whole };

struct EvaluatedPlane {
    Candidate candidate;
    TermStage stage = TermStage::none;
    std::optional<CutEvaluation> evaluation = {};  // nothing from `solids` on: the plane misses
    bool is_really_cut = false;                    // its inaccessible area is that of the pieces that it really makes
};

// Planes of one normal, their offsets ascending.
using PlanesOfNormal = std::vector<EvaluatedPlane>;

// Candidates that follow each other as for evaluate_all, nothing evaluated.
std::vector<PlanesOfNormal> by_normal(std::span<const Candidate> candidates);

// How many planes are evaluated at least up to a stage.
std::size_t count_evaluated(std::span<const PlanesOfNormal> planes, TermStage stage);

// Evaluates planes of one normal up to a stage, in one sweep per stage (sweep.h). Preconditions: all are at the same
// stage, below `to`; their offsets ascend and are nudged; where they have their solids, no plane misses; `prepared` is
// made with the same objectives.
void evaluate(std::span<EvaluatedPlane* const> planes, TermStage to, const PreparedPiece& prepared,
              const Objectives& objectives);

}  // namespace qchopper
