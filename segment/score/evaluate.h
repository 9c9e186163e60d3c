// Evaluations many candidates at once, on all cores; the result does not depend on their number.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/score/candidates.h"
#include "segment/score/reference.h"

namespace qchopper {

// One evaluation per candidate, in their order.
std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context);

}  // namespace qchopper
