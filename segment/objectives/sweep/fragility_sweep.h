// Measures how much thin material a cut leaves beside its plane, both forms of the second objective, for all offsets of
// one normal in one pass over faces or vertices.
//
// mm. Measured on the piece before the cut; old caps count as surface. Equal to the plain sums in tests/reference for
// each offset to 1e-9 (tests/segment/objectives/sweep/sweep_test.cpp), and the same bits for any number of threads
// (tests/segment/search/candidates/candidates_test.cpp). One ray per face serves all offsets that do not cross the
// face.

#pragma once

#include <span>
#include <vector>

#include "segment/objectives/sweep/prepared.h"

namespace qchopper {

// Both return one sum per offset. Preconditions: `offsets` ascending, the normal canonical (plane.h), `distance` not
// negative.

// Thinness before it is divided by the cap area, in mm2: sum of A_T (1 - dist(c_T, P)/d) (s n_T . n_P) over the faces
// within d = `distance` of the plane that face away from it (s n_T . n_P at least 0.9, s = 1 above the plane, -1 below)
// and from which the parallel ray to the plane meets no other surface. A crossed face counts as its part on that side.
std::vector<double> sweep_thinness(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                   double distance);

// In mm, Nicholson 2016, section 4.2.2 as printed: sum of dist(V, P) * |n_V . n_P| over the vertices within `distance`
// with |n_V . n_P| >= 0.9. Precondition: `prepared` holds vertex normals (FragilityForm::thesis).
std::vector<double> sweep_thesis_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance);

}  // namespace qchopper
