// Times one cut by a general library, CGAL's clip of both sides of a plane, for comparison.

#pragma once

#include <cstddef>

#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

struct ClipResult {
    double cpu_s = 0;  // both sides; without copying the mesh into CGAL's
    std::size_t faces_above = 0;
    std::size_t faces_below = 0;
    bool is_closed = false;
};

// Both halves are capped (clip_volume). Precondition: the mesh is closed.
ClipResult cgal_clip(const TriangleMesh& mesh, const Plane& plane);

}  // namespace qchopper::bench
