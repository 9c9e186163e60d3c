// The quick way through the PLY file that most scanners write: binary little-endian, vertices of fixed size and then
// triangles with 32-bit indices and nothing else.
//
// What it reads, parse_ply would read the same (tests/segment/io/read_plain_ply_test.cpp).

#pragma once

#include <optional>
#include <string_view>

#include "segment/io/ply_header.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Nothing for any other layout, and for a file with anything wrong in it: the careful reader says what.
std::optional<RawMesh> read_plain_ply(const PlyHeader& header, std::string_view file);

}  // namespace qchopper
