// Writes a mesh as binary PLY, which keeps every bit, or as binary STL, in single precision, by the ending of the name.

#pragma once

#include <filesystem>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Throws InputError (use) for another ending than .ply and .stl.
void check_mesh_name(const std::filesystem::path& file);

// Throws what check_mesh_name and write_file throw.
void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace qchopper
