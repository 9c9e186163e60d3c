// Distances from many points along or against one normal to where the rays leave a closed mesh.
//
// mm. Exact to double rounding: compared with the definition, one triangle at a time
// (tests/segment/raster/parallel_rays_test.cpp). The result does not depend on the number of threads. Precondition: the
// mesh is closed (edges.h) and the normal is a unit vector.

#pragma once

#include <limits>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct RayQuery {
    Vec3 from;
    bool up = false;                                         // along the normal; false: against it
    double reach = std::numeric_limits<double>::infinity();  // how far it is looked, at least 0
};

// One distance per query: to the first surface through which the ray leaves the mesh; infinite if there is none within
// its reach. A surface through which the ray enters is ignored, so a ray that starts on a face and runs inwards does
// not end there. The shorter the reach, the faster.
std::vector<double> ray_distances(const TriangleMesh& mesh, Vec3 normal, std::span<const RayQuery> queries);

}  // namespace qchopper
