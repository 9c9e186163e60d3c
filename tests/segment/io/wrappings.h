// Builds the wrappings that scans come in: gzip, UTF-16, glTF with its numbers inside, 3MF packages.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

Bytes gzipped(const Bytes& bytes);
// With its byte order mark.
Bytes utf16(const std::string& text, bool is_big_endian);

// A glTF text whose only buffer holds `numbers`; `rest` is what follows the buffers in the JSON.
std::string gltf_text(const Bytes& numbers, const std::string& rest);
// The points as floats, three each.
Bytes float_points(const std::vector<Vec3>& points);
// A glTF of one node with the mesh, points first and then corners of 32 bits; `node` goes into the node.
std::string gltf_of(const TriangleMesh& mesh, const std::string& node = R"("mesh":0)");
// The same text with the numbers in the second chunk.
Bytes glb_of(const std::string& json, const Bytes& numbers);

// A package with these parts, and the relations that lead to the first.
Bytes package_3mf(const std::vector<std::pair<std::string, std::string>>& parts);
// <object> with the mesh.
std::string object_3mf(const TriangleMesh& mesh, int id, const std::string& attributes = {});
std::string model_3mf(const std::string& resources, const std::string& build, const std::string& attributes = {});

}  // namespace qchopper
