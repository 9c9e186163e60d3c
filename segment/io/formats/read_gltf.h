// Reads glTF of version 2, as JSON or GLB, every node at its place. The glTF part of read_mesh.h.
//
// glTF has metres and Y up; the scan has metres and Z up: (x, y, z) becomes (x, -z, y). Triangles, strips and fans are
// read, also quantized and sparse points; lines, points, images and animations are not (docs/user/scan-formats.md,
// tests/segment/io/formats/read_gltf_test.cpp). The JSON is filtered by gltf_json.h and read by tinygltf.

#pragma once

#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the first character that is not white space is a brace, as in any JSON object.
bool is_gltf(const Bytes& bytes);

// Bytes that are no GLB are read as JSON. Files that it names are read from `folder` and below it, nowhere else; with
// an empty folder it must name none. Throws InputError (mesh) for a file that is damaged, exceeds the limits of
// docs/user/scan-formats.md or requires an extension that is not read, (missing) if a file beside it cannot be read;
// `name` stands for the file.
RawMesh parse_gltf(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder);

}  // namespace qchopper
