// Reads a PLY file in which part of the surface is marked: by a property of its vertices, or by their colour.
//
// Marked is a vertex of which a property named `ignore` or `mask` (as CloudCompare writes it: `scalar_ignore`,
// `scalar_mask`) is not 0. Without such a property its colour decides (red, green, blue, or diffuse_red and so on; 0 to
// 255, or 0 to 1 as real numbers): painted red, red at least 200 and green and blue at most 60. A triangle is marked if
// two of its corners are (tests/segment/io/read_painted_test.cpp).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// In the unit of the file, with TriangleMesh::ignored filled in. `name` stands for the file. Throws InputError (mesh):
// what parse_ply throws, and for a file that is no PLY or has neither such a property nor colours.
TriangleMesh parse_painted_ply(const Bytes& bytes, const std::string& name);

// A surface on which points are marked.
struct MarkedPoints {
    TriangleMesh mesh;                    // in the unit of the file
    std::vector<std::uint8_t> is_marked;  // one per point: 1 or 0
};

// The same for surface that must not be cut: the property is named `no_cut` or `mask` (`scalar_no_cut`, `scalar_mask`),
// and the marks are those of the vertices. Throws as above.
MarkedPoints parse_no_cut_ply(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
