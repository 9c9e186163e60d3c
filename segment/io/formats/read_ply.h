// Reads PLY, as ASCII and in both binary orders; unknown elements and properties are skipped. The PLY part of
// read_mesh.h (tests/segment/io/read_mesh_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the first word is "ply".
bool is_ply(const Bytes& bytes);

// Expects is_ply(bytes); any other bytes are read soundly or refused. Throws InputError (mesh), with the line or byte,
// for a file that is damaged or has no faces; `name` stands for the file.
RawMesh parse_ply(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
