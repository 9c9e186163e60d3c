// The OBJ side of read_mesh: points and faces of a Wavefront OBJ text; texture, normals and groups are passed over.
//
// Polygons, negative numbers and faces that name later points are read. Our own reader, because every number is to
// come out as it stands there and every fault with its line (docs/decisions/0013-text-formats-are-read-by-us.md).

#pragma once

#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether the first line that says anything begins with a word of the format: OBJ has no other mark.
bool is_obj(const Bytes& bytes);

// Throws InputError (mesh) for anything that is not such a file.
RawMesh parse_obj(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
