// Binary fragility: whether a vertex near a plane stands over material that the cut would leave thin (Luo et al.,
// "Chopper: partitioning models into 3D-printable parts", 2012, section 3.4, made precise in
// docs/developer/objectives.md).
//
// mm. A vertex at most `distance` from the plane, on the side s (1 above, -1 below), counts if its outward normal n
// looks away from the plane (s n . n_P >= 0.9), or if s n . n_P > 0 and the edges at it all go up, all go down, or
// change between up and down more than twice around it. It is dropped if the ray from it straight towards the plane
// leaves the piece before the plane. A vertex of a cap is also asked with the cap's outward normal. Equal to the plain
// form in tests/reference, exactly (tests/segment/objectives/sweep/chopper_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/objectives/sweep/prepared.h"

namespace qchopper {

// One value per offset: 1 if such a vertex is left, else 0. Preconditions: `offsets` ascending, distance >= 0,
// `prepared` holds vertex normals. O(points), and the triangles where it does not suffice to look at normals; few rays,
// because one vertex decides for all planes within its distance.
std::vector<double> sweep_binary_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance);

}  // namespace qchopper
