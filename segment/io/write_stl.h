// Writes a mesh as binary STL: single precision, one normal and three points per triangle.
//
// Coordinates are rounded to float, so shift a mesh near the origin first. The header never begins with "solid"
// (tests/segment/io/write_mesh_test.cpp).

#pragma once

#include "base/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

Bytes to_stl(const TriangleMesh& mesh);

}  // namespace qchopper
