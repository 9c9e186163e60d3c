// The asymmetry of points about a plane, pair by pair: the reference of symmetry_plane()
// (segment/objectives/symmetry_plane.h).

#pragma once

#include <span>

#include "segment/mesh/plane.h"

namespace qchopper {

// The score of one plane, on both sides of points that are spread evenly over a surface; infinite where all lie on one
// side. O(points squared).
double symmetry_score(std::span<const Vec3> points, const Plane& plane);

}  // namespace qchopper
