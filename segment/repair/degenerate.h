// Removes triangles whose three corners lie on one line, without opening the surface and without moving a point.
//
// Such a triangle has its middle corner on its longest edge; the neighbour there is split at that corner instead, which
// leaves the surface where it is. At an open border the triangle is dropped (tests/segment/repair/degenerate_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// Whether the height of the triangle is not above 1e-15 of its longest edge, which is rounding.
bool is_degenerate(const TriangleMesh& mesh, std::size_t triangle);

struct Degenerate {
    std::size_t flipped = 0;  // removed, and the neighbour at the longest edge split
    std::size_t dropped = 0;  // at an open border
    std::size_t left = 0;     // the surface around them allows neither
};

// Precondition: the mesh is manifold apart from its borders (split_non_manifold.h) and has no caps. Triangles that
// changed count as new in the sources.
Degenerate remove_degenerate(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
