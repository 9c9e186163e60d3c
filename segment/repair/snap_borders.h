// Merges border points that lie close together: for scans whose strips meet with a gap.
//
// Only ends of open edges move, each to the first of its group; no group is wider than the tolerance, and the ends of
// one edge are never merged. Points and triangles keep their order (tests/segment/repair/snap_borders_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct SnapBorders {
    std::size_t welded = 0;  // points merged with an earlier point
    double farthest = 0;     // the largest distance that one of them moved, in units of the mesh
};

// Precondition: equal points are welded. The tolerance is in units of the mesh; 0 changes nothing.
SnapBorders weld_borders(TriangleMesh& mesh, double tolerance, SourceFaces* sources = nullptr);

}  // namespace qchopper
