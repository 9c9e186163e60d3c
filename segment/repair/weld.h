// Merges points with exactly equal coordinates, drops the triangles that this collapses and the points of no triangle.
//
// Points and triangles that stay keep their order and their bits (-0.0 becomes 0.0). A second call changes nothing
// (tests/segment/repair/weld_test.cpp).

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

// Caps are kept in step with the triangles.
WeldCounts weld(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
