// Merges points: those with exactly equal coordinates, and border points that lie close together.
//
// Points and triangles that stay keep their order and their bits (-0.0 becomes 0.0). A second call of weld() changes
// nothing (tests/segment/repair/weld_test.cpp, tests/segment/repair/snap_borders_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct WeldCounts {
    std::size_t welded = 0;        // points merged with an earlier point
    std::size_t collapsed = 0;     // triangles dropped because two of their corners are equal
    std::size_t unreferenced = 0;  // points dropped because no triangle uses them
    bool operator==(const WeldCounts&) const = default;
};

// Drops the triangles that this collapses and the points of no triangle. Caps are kept in step with the triangles.
WeldCounts weld(TriangleMesh& mesh, SourceFaces* sources = nullptr);

struct SnapBorders {
    std::size_t welded = 0;  // points merged with an earlier point
    double farthest = 0;     // the largest distance that one of them moved, in units of the mesh
};

// For scans whose strips meet with a gap: only ends of open edges move, each to the first of its group; no group is
// wider than the tolerance, and the ends of one edge are never merged. Precondition: equal points are welded. The
// tolerance is in units of the mesh; 0 changes nothing.
SnapBorders snap_borders(TriangleMesh& mesh, double tolerance, SourceFaces* sources = nullptr);

}  // namespace qchopper
