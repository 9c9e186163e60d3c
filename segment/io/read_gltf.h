// The glTF side of read_mesh: version 2 as JSON or GLB, read by tinygltf, every node at its place.
//
// glTF has metres and Y up; the scan comes out in metres with Z up: (x, y, z) becomes (x, -z, y). Triangles, strips and
// fans are read, quantized and sparse points too; lines, points, pictures and movement are not.

#pragma once

#include <filesystem>
#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether the first thing in it is a brace, as in any JSON.
bool is_gltf(const Bytes& bytes);

// Files that it names are looked for in `folder` and below it, nowhere else; without a folder it must not name any.
// Throws InputError (mesh) for anything that is not such a file, (missing) for a file beside it that is not there.
RawMesh parse_gltf(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder);

}  // namespace qchopper
