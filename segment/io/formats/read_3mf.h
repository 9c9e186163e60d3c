// Reads the objects, components and build items of a 3MF package (core specification 1.3), every item at its place, in
// the unit that the model declares; millimetres where it declares none. The 3MF part of read_mesh.h.
//
// Further model files (production extension) are read. Colours and slices are ignored; supports and other objects that
// are not to be made are left out with a warning. libzip reads the package, expat its XML
// (tests/segment/io/formats/read_3mf_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

// Whether the bytes begin with the mark of a ZIP.
bool is_3mf(const Bytes& bytes);

// Throws InputError (mesh) for bytes that are no ZIP, a ZIP that is damaged or holds no 3MF, more than the limits of
// docs/user/scan-formats.md, and a required extension that is not read; `name` stands for the file.
RawMesh parse_3mf(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
