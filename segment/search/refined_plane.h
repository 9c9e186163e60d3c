// Moves and turns a plane a little, so that less of both sides is out of reach.
//
// mm. The candidates of a piece have 132 normals, some ten degrees apart, and 80 offsets; between them a plane can be
// better. What it leaves is asked with dense directions (segment/access/dense_access.h), because the scan's own favour
// the normals that are among them.

#pragma once

#include <functional>

#include "base/context.h"
#include "segment/access/dense_access.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct RefinedPlane {
    Plane plane;  // canonical, not nudged
    double unreachable_mm2 = 0;
};

// The best plane that a pattern search finds (Hooke and Jeeves, "Direct search" solution of numerical and statistical
// problems, 1961): of six neighbours, `step` along the normal and three degrees about two axes through the middle of
// the piece, the best is taken while it leaves less; then once more with half the steps. The plane `from` itself
// if none leaves less. Precondition: step_mm > 0. Some 25 planes at most. Throws Cancelled.
// `is_allowed`: planes of which it is false are left out; empty: none is. Without `may_turn` it is only moved.
RefinedPlane refined_plane(DenseAccess& access, const Piece& piece, const Plane& from, double step_mm,
                           const Context& context, const std::function<bool(const Plane&)>& is_allowed = {},
                           bool may_turn = true);

}  // namespace qchopper
