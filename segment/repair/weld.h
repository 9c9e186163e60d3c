// Makes one point of all points with exactly the same coordinates, and drops what that leaves without use.
//
// Points and triangles that stay keep their order and their bits (-0.0 becomes 0.0). Welding twice is welding once
// (tests/segment/repair/weld_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct WeldCounts {
    std::size_t welded = 0;        // points that became one with an earlier point
    std::size_t collapsed = 0;     // triangles dropped because two of their corners are one point
    std::size_t unreferenced = 0;  // points dropped because no triangle uses them
    bool operator==(const WeldCounts&) const = default;
};

WeldCounts weld(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
