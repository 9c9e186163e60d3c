// Reads the PLY files that most scanners write at the speed of memory: binary little-endian, vertices of fixed size,
// then triangles with 32-bit indices and nothing else.
//
// The result is that of parse_ply's general reader, bit for bit (tests/segment/io/formats/read_plain_ply_test.cpp).

#pragma once

#include <optional>
#include <string_view>

#include "segment/io/formats/ply_header.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Nothing for any other layout and for a file with a fault in it: the general reader then reports the fault.
// Precondition: `header` is read_ply_header(file).
std::optional<RawMesh> read_plain_ply(const PlyHeader& header, std::string_view file);

}  // namespace qchopper
