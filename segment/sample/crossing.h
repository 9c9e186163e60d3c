// Whether two triangles of a mesh meet anywhere but in the points that they share.
//
// When in doubt (flat against each other, touching) the answer is yes.

#pragma once

#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

bool triangles_cross(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b);

}  // namespace qchopper
