// Transforms a mesh to another frame.
//
// mm. Triangles and caps stay. O(points). Precondition: that of base/pose.h.

#pragma once

#include "base/pose.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

inline TriangleMesh apply(const Pose& a_in_b, TriangleMesh mesh) {
    for (Vec3& p : mesh.points) p = apply(a_in_b, p);
    return mesh;
}

}  // namespace qchopper
