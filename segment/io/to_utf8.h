// Takes the mark from the start of a text, and makes bytes of UTF-16.
//
// Some programs on Windows save OBJ and PLY as UTF-16. What such a file says about a mesh is ASCII; other characters
// stand in names and comments only and become question marks (tests/segment/io/unpack_test.cpp).

#pragma once

#include <optional>

#include "base/file.h"

namespace qchopper {

// Nothing where the bytes begin with no byte order mark: then they are right as they are.
std::optional<Bytes> to_utf8(const Bytes& bytes);

}  // namespace qchopper
