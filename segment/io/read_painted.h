// Reads a PLY file in which part of the surface is marked: by a property of its vertices, or by their colour.
//
// Marked is a vertex of which a property named `ignore` or `mask` (as CloudCompare writes it: `scalar_ignore`,
// `scalar_mask`) is not 0. Without such a property its colour decides (red, green, blue, or diffuse_red and so on; 0 to
// 255, or 0 to 1 as real numbers): painted red, red at least 200 and green and blue at most 60. A triangle is marked if
// two of its corners are (tests/segment/io/read_painted_test.cpp).

#pragma once

#include <string>

#include "base/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// In the unit of the file, with TriangleMesh::ignored filled in. `name` stands for the file. Throws InputError (mesh):
// what parse_ply throws, and for a file that is no PLY or has neither such a property nor colours.
TriangleMesh parse_painted_ply(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
