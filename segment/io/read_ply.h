// The PLY side of read_mesh: ASCII and both binary orders, with any further elements and properties.

#pragma once

#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether the first line is "ply".
bool is_ply(const Bytes& bytes);

// Throws InputError (mesh) for anything that is not such a file.
RawMesh parse_ply(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
