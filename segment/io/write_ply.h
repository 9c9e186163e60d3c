// Writes a mesh as binary little-endian PLY with double coordinates.
//
// A mesh with caps carries an int face property `cap` (TriangleMesh::cap_of). Reading it back gives the same bits
// (tests/segment/io/write_mesh_test.cpp).

#pragma once

#include "base/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

Bytes to_ply(const TriangleMesh& mesh);

}  // namespace qchopper
