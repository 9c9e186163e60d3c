// Writes a mesh, in millimetres, as binary PLY, which keeps every bit, or as binary STL, in single precision.
//
// PLY: little-endian with double coordinates; TriangleMesh::cap_of becomes the int face property `cap`, which a mesh
// without caps does not have. Reading the file gives the same bits. STL: one normal and three points per triangle;
// coordinates are rounded to float, so the mesh should lie near the origin. The header does not begin with "solid"
// (tests/segment/io/write_mesh_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Precondition: is_consistent(mesh).
Bytes to_ply(const TriangleMesh& mesh);

// What a PLY has beside the mesh, per triangle: the uint property `region` and the colour as red, green and blue.
struct PlyFaces {
    std::vector<std::uint32_t> region;
    std::vector<std::array<std::uint8_t, 3>> colour;
};

// Preconditions: is_consistent(mesh), and both have a value per triangle.
Bytes to_ply(const TriangleMesh& mesh, const PlyFaces& faces);

// Preconditions: is_consistent(mesh), fewer than 2^32 triangles.
Bytes to_stl(const TriangleMesh& mesh);

// Throws InputError (use) for another ending than .ply and .stl.
void check_mesh_name(const std::filesystem::path& file);

// Throws what check_mesh_name and write_file throw.
void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace qchopper
