// A plane whose terms are evaluated in stages, the cheap ones first, so that the slow ones can wait until the plane may
// still be among the best (best_first.h).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/objectives/objectives.h"
#include "segment/search/candidates/candidates.h"

namespace qchopper {

struct PreparedPiece;

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

// How many planes are evaluated at least up to a stage.
std::size_t count_evaluated(std::span<const PlanesOfNormal> planes, TermStage stage);

// Evaluates planes of one normal up to a stage, in one sweep per stage (sweep.h). Preconditions: all are at the same
// stage, below `to`; their offsets ascend and are nudged; where they have their solids, no plane misses; `prepared` is
// made with the same objectives.
void evaluate(std::span<EvaluatedPlane* const> planes, TermStage to, const PreparedPiece& prepared,
              const Objectives& objectives);

}  // namespace qchopper
