// The wrapping of a GLB: a header, a chunk of JSON and a chunk of numbers. A plain glTF is JSON from end to end.

#pragma once

#include <cstddef>
#include <string>

#include "base/file.h"

namespace qchopper {

// Whether it begins with "glTF", the mark of a GLB.
bool is_glb(const Bytes& bytes);

// Where the JSON lies.
struct GltfPlace {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t end_of_file = 0;  // what a GLB says of itself; anything behind that is not its own
    bool is_glb = false;
};

// Throws InputError (mesh) for a GLB whose header or first chunk is wrong.
GltfPlace json_in(const Bytes& bytes, const std::string& name);

// The same GLB with another JSON.
Bytes glb_with(const Bytes& bytes, const GltfPlace& old, std::string json);

}  // namespace qchopper
