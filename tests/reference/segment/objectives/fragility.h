// Measures how much thin material a cut leaves beside its plane: both forms of the second objective.
//
// mm. Measured on the piece before the cut; old caps count as surface. The plain sums that fragility_sweep.h is tested
// against. Invariants (tests/segment/objectives/fragility_test.cpp): a slab of thickness t < d left on one side gives
// thinness 1 - t/d whatever its mesh; a ball of radius r cut at 0.95 r with d = r gives 0.9748.

#pragma once

#include "segment/cut/piece.h"

namespace qchopper {

// (1 / cap area) * sum of A_T (1 - dist(c_T, P)/d) (s n_T . n_P) over the faces within d = `distance` of the plane that
// face away from it (s n_T . n_P at least 0.9, s = 1 above the plane, -1 below) and from which the parallel ray to the
// plane meets no other surface. A crossed face counts as its part on that side. Preconditions: a closed mesh,
// cap_area_mm2 > 0, distance >= 0, the normal canonical (plane.h).
double thinness(const Piece& piece, const Plane& plane, double cap_area_mm2, double distance);

// Nicholson 2016, section 4.2.2 as printed: sum of dist(V, P) * |n_V . n_P| in mm over the vertices within `distance`
// with |n_V . n_P| >= 0.9.
double thesis_fragility(const Piece& piece, const Plane& plane, double distance);

}  // namespace qchopper
