// The zero surface of a field as triangles, by marching through tetrahedra.
//
// Lengths in mm. Each tetrahedron of a body-centred cubic lattice holds one flat or twice bent piece of the surface
// whose corners lie on its edges, so the whole is closed, manifold and never meets itself, whatever the field
// (tests/segment/sample/surface_test.cpp). Triangles come in the order of an octree: neighbours lie close together.

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/field.h"

namespace qchopper {

// How many triangles surface() would give.
std::size_t count_triangles(const BoneField& field, const Box& box, double spacing, const Context& context);

// The surface must lie inside the box. `spacing` is the edge of a lattice cell.
TriangleMesh surface(const BoneField& field, const Box& box, double spacing, const Context& context);

}  // namespace qchopper
