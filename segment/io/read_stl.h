// The STL side of read_mesh: both kinds, told apart by length, never by the word "solid".

#pragma once

#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether the length is exactly what the triangle count at byte 80 asks for.
bool is_binary_stl(const Bytes& bytes);
// "a binary STL of 5000 triangles has 250084 bytes, but the file has 25084"
std::string why_no_binary_stl(const Bytes& bytes);
// Whether it begins with "solid" and goes on as text.
bool is_ascii_stl(const Bytes& bytes);

// Throw InputError (mesh) for anything that is not such a file. The binary one must be is_binary_stl. With `weld` its
// equal points become one, the first, as they are read.
RawMesh parse_binary_stl(const Bytes& bytes, const std::string& name, bool weld = false);
RawMesh parse_ascii_stl(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
