// Reads the text form of Geomview's Object File Format, with or without normals and colours. The OFF part of
// read_mesh.h.
//
// One point or face per line, as all writers write them; the rest of the line is ignored. It is a reader of our own for
// the reasons in docs/decisions/0013-text-formats-are-read-by-us.md (tests/segment/io/formats/read_off_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the first word is OFF, or OFF after the letters that announce colours, normals and the like.
bool is_off(const Bytes& bytes);

// Expects is_off(bytes); any other bytes are read soundly or refused. Throws InputError (mesh), with the line, for a
// file that is damaged or has points of more than three coordinates, and for binary OFF; `name` stands for the file.
RawMesh parse_off(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
