// Measures both forms of fragility for all offsets of one normal in one pass over faces or vertices.
//
// mm. Equal to fragility.h for each offset to 1e-9 (tests/segment/score/sweep_test.cpp), and the same bits for any
// number of threads (tests/segment/score/candidates_test.cpp). One ray per face serves all offsets that do not cross
// the face.

#pragma once

#include <span>
#include <vector>

#include "segment/score/prepared.h"

namespace qchopper {

// Both return one sum per offset. Preconditions: `offsets` ascending, the normal canonical (plane.h), `distance` not
// negative.

// Thinness before it is divided by the cap area: in mm2.
std::vector<double> sweep_thinness(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                   double distance);

// In mm. Precondition: `prepared` holds vertex normals (FragilityForm::thesis).
std::vector<double> sweep_thesis_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance);

}  // namespace qchopper
