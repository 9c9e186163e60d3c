// The same small box in every encoding that the readers know: for tests that damage files, and as seeds for fuzzers.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Encoded {
    std::string reader;  // "ply", "stl", "obj", "off", "gltf", "3mf", or "any" for wrapped ones
    std::string name;    // "little-endian"
    Bytes bytes;
    std::size_t may_miss = 0;  // so many bytes at the end mean nothing
};

// 12 faces about 8 corners, in as many ways as there are.
std::vector<Encoded> encodings();

}  // namespace qchopper
