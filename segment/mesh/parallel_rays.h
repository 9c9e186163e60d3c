// How far one can go straight along or against a normal inside a closed mesh, for many points at once.
//
// All ways of one normal are parallel, so no ray tree is needed: the points are sorted into a grid across the normal
// and the triangles pass over it once. Exact to double rounding; lengths in mm. Held against the definition, one
// triangle at a time (tests/segment/mesh/parallel_rays_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct RayQuery {
    Vec3 from;
    bool up = false;  // along the normal; false: against it
};

// Per query the distance to the first surface through which the way leaves the mesh; infinite if it meets none within
// `most`.
// A surface that the way would enter through is passed over, so a point on a face that goes inwards does not see it.
std::vector<double> ray_distances(const TriangleMesh& mesh, Vec3 normal, std::span<const RayQuery> queries,
                                  double most);

}  // namespace qchopper
