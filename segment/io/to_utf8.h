// Removes the byte order mark of a text and converts UTF-16 to bytes.
//
// Some programs on Windows save OBJ and PLY as UTF-16. All that describes a mesh is ASCII; other characters occur in
// names and comments only and become question marks (tests/segment/io/formats/unpack_test.cpp).

#pragma once

#include <optional>

#include "base/files/file.h"

namespace qchopper {

// Nothing if the bytes begin with no byte order mark: they need no conversion.
std::optional<Bytes> to_utf8(const Bytes& bytes);

}  // namespace qchopper
