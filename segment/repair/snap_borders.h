// Makes one point of border points that lie close together: for scans whose strips meet with a gap.
//
// Only ends of open edges move, each to the first of its cluster; no cluster is wider than the tolerance, and the ends
// of one edge never become one. Points and triangles keep their order (tests/segment/repair/snap_borders_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct SnapBorders {
    std::size_t welded = 0;  // points that became one with an earlier point
    double farthest = 0;     // that one of them moved
};

// Equal points must have been welded. The tolerance is in units of the mesh.
SnapBorders weld_borders(TriangleMesh& mesh, double tolerance, SourceFaces* sources = nullptr);

}  // namespace qchopper
