// Reads the points and faces of a Wavefront OBJ text; textures, normals and groups are ignored. The OBJ part of
// read_mesh.h.
//
// Polygons, negative indices and faces that name later points are read. It is a reader of our own so that every number
// is read as written and every fault has its line (docs/decisions/0013-text-formats-are-read-by-us.md,
// tests/segment/io/formats/read_obj_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the first word that is not in a comment is a keyword of the format, or a line with a point follows after
// lines of text: OBJ has no other mark. O(bytes) at most.
bool is_obj(const Bytes& bytes);

// Throws InputError (mesh) with the line for a line that is damaged and for a face that names no point; `name` stands
// for the file. A file without faces is read as such.
RawMesh parse_obj(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
