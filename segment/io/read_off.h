// The OFF side of read_mesh: the text form of Geomview's Object File Format, with or without normals and colours.
//
// One point and one face in a line, as every writer has them; what follows in the line is passed over. Our own reader:
// docs/decisions/0013-text-formats-are-read-by-us.md.

#pragma once

#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether the first word is OFF, or OFF with the letters that announce colours, normals and the like.
bool is_off(const Bytes& bytes);

// Throws InputError (mesh) for anything that is not such a file, and for binary OFF.
RawMesh parse_off(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
