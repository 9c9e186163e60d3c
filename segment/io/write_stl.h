// Writes a mesh as binary STL: single precision, one normal and three points per triangle, in millimetres.
//
// Coordinates are rounded to float: the mesh should lie near the origin. The header does not begin with "solid"
// (tests/segment/io/write_mesh_test.cpp).

#pragma once

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Preconditions: is_consistent(mesh), fewer than 2^32 triangles.
Bytes to_stl(const TriangleMesh& mesh);

}  // namespace qchopper
