// Reads binary and ASCII STL; a binary file is identified by its length, not by the word "solid". The STL part of
// read_mesh.h (tests/segment/io/read_mesh_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the length is exactly that of the triangle count at byte 80.
bool is_binary_stl(const Bytes& bytes);
// "a binary STL of 5000 triangles has 250084 bytes, but the file has 25084"
std::string why_no_binary_stl(const Bytes& bytes);
// Whether the first word is "solid" and no zero byte follows within 1,024 bytes.
bool is_ascii_stl(const Bytes& bytes);

// Precondition: is_binary_stl(bytes). With `weld` equal points become one, the first of them, as they are read. Throws
// InputError (mesh) for a coordinate that is not finite and for more than 1.4 billion triangles; `name` stands for the
// file.
RawMesh parse_binary_stl(const Bytes& bytes, const std::string& name, bool weld = false);
// Throws InputError (mesh), with the line, for a text that is damaged.
RawMesh parse_ascii_stl(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
