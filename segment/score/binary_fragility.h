// Binary fragility: whether a vertex near a plane stands over material that the cut would leave thin (Luo et al.,
// "Chopper: partitioning models into 3D-printable parts", 2012, section 3.4, made precise in
// docs/developer/objectives.md).
//
// mm. A vertex at most `distance` from the plane, on the side s (1 above, -1 below), counts if its outward normal n
// looks away from the plane (s n . n_P >= 0.9), or if s n . n_P > 0 and the edges at it all go up, all go down, or
// change between up and down more than twice around it. It is dropped if the ray from it straight towards the plane
// leaves the piece before the plane. A vertex of a cap is also asked with the cap's outward normal. The sweep gives
// what the plain form gives, exactly (tests/segment/score/chopper_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/score/prepared.h"

namespace qchopper {

// 1 if such a vertex is left, else 0. Preconditions: a closed mesh, the normal canonical (plane.h), distance >= 0.
// O(triangles), and a ray per vertex that counts.
double binary_fragility(const Piece& piece, const Plane& plane, double distance);

// One value per offset. Preconditions: `offsets` ascending, `prepared` holds vertex normals. O(points), and the
// triangles where it does not suffice to look at normals; few rays, because one vertex decides for all planes within
// its distance.
std::vector<double> sweep_binary_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance);

}  // namespace qchopper
