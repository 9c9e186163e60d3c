// Writes a mesh as binary little-endian PLY with double coordinates, in millimetres.
//
// TriangleMesh::cap_of becomes the int face property `cap`, which a mesh without caps does not have. Reading the file
// gives the same bits (tests/segment/io/write_mesh_test.cpp).

#pragma once

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Precondition: is_consistent(mesh).
Bytes to_ply(const TriangleMesh& mesh);

}  // namespace qchopper
