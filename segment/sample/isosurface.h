// Triangulates the isosurface of a field at value 0.
//
// Lengths in mm. Precondition: the isosurface lies inside the box. Each tetrahedron of a body-centred cubic lattice has
// at most two triangles, whose corners lie on its edges, so the mesh is closed and manifold and does not intersect
// itself, whatever the field (tests/segment/sample/isosurface_test.cpp). Triangles come in the order of an octree:
// neighbours lie close together. `spacing` is the edge of a lattice cell. Both functions throw Cancelled
// (base/context.h).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/field.h"

namespace qchopper {

// The number of triangles of isosurface() with the same arguments.
std::size_t count_triangles(const BoneField& field, const Box& box, double spacing, const Context& context);

TriangleMesh isosurface(const BoneField& field, const Box& box, double spacing, const Context& context);

}  // namespace qchopper
