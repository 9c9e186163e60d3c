// Takes away triangles whose three corners lie on one line, without opening the surface and without moving a point.
//
// Such a triangle has its middle corner on its longest edge; the neighbour there is split at that corner instead, which
// changes no place of the surface. At an open border the triangle just goes (tests/segment/repair/degenerate_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// Whether the height of the triangle is nothing but rounding: below 1e-15 of its longest edge.
bool is_degenerate(const TriangleMesh& mesh, std::size_t triangle);

struct Degenerate {
    std::size_t flipped = 0;  // gone, and the neighbour at the longest edge split
    std::size_t dropped = 0;  // gone at an open border
    std::size_t left = 0;     // the surface around them allows neither
};

// The mesh must be manifold apart from its borders (sheets.h) and have no caps. Triangles that changed are new.
Degenerate remove_degenerate(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
