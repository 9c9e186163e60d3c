// Reads a scan from a PLY or STL file as it stands: nothing is welded, shifted or scaled.
//
// Coordinates are in the file's own unit. The format is told by the content, never by the name. Whatever the bytes,
// the answer is a mesh with finite coordinates and valid indices or an InputError (mesh) that says what is wrong and
// at which line or byte (tests/segment/intake/read_mesh_test.cpp).

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "segment/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class MeshFormat { ply_ascii, ply_little_endian, ply_big_endian, stl_ascii, stl_binary };

// "PLY, binary little-endian"
std::string name_of(MeshFormat format);

struct RawMesh {
    TriangleMesh mesh;  // an STL file names three points of its own per triangle; cap_of comes from a PLY face property
    MeshFormat format = MeshFormat::ply_ascii;
    std::size_t faces_in_file = 0;       // polygons count once
    std::size_t faces_without_area = 0;  // with fewer than three corners: left out
};

// Throws InputError (missing) for a file that cannot be read, (mesh) for one that is wrong.
RawMesh read_mesh(const std::filesystem::path& path);

// The same from bytes in memory; `name` stands for the file in errors.
RawMesh parse_mesh(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
