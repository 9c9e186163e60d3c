// Evaluations a plane by really cutting along it and looking at what came out.
//
// As plain as it can be: the faster ways of evaluation are tested against it for equality.

#pragma once

#include <optional>

#include "segment/cut/piece.h"
#include "segment/score/cut_evaluation.h"
#include "segment/score/objectives.h"

namespace qchopper {

// Nothing if the plane misses the piece.
std::optional<CutEvaluation> evaluate_by_cutting(const Piece& piece, const Plane& plane, const Objectives& objectives);

// The same ingredients of a piece as it is.
SolidEvaluation measure(const Piece& piece);

}  // namespace qchopper
