// Evaluates a plane by cutting the piece along it and measuring the halves.
//
// The reference: as plain as possible, the sweep is tested for equality with it
// (tests/segment/objectives/sweep/sweep_test.cpp). It agrees with the pieces that the cut makes
// (tests/segment/objectives/sweep/reference_test.cpp). mm.

#pragma once

#include <array>
#include <optional>

#include "segment/cut/cut_evaluation.h"
#include "segment/cut/piece.h"
#include "segment/objectives/objectives.h"

namespace qchopper {

// Nothing if the plane misses the piece. Preconditions as for cut() (cut.h). Throws InputError if the mesh is open
// where the plane passes.
// `box_axes`: as in prepare() (prepared.h).
std::optional<CutEvaluation> evaluate_by_cutting(const Piece& piece, const Plane& plane, const Objectives& objectives,
                                                 const std::array<Vec3, 3>* box_axes = nullptr);

}  // namespace qchopper
