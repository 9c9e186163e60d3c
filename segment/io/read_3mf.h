// The 3MF side of read_mesh: objects, components and build items of a package (core specification 1.3), every item at
// its place, in the unit that the model declares; millimetres where it declares none.
//
// The production extension's further model files are read. Colours and slices are passed over; supports and other
// things that are not to be made are left out with a warning. The package is read by libzip, its XML by expat.

#pragma once

#include <string>

#include "base/file.h"
#include "segment/io/raw_mesh.h"

namespace qchopper {

// Whether it begins like a ZIP.
bool is_3mf(const Bytes& bytes);

// Throws InputError (mesh) for anything that is not such a file.
RawMesh parse_3mf(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
