// Finds and replaces the JSON of a GLB file: a header, a chunk of JSON and a chunk of numbers. A glTF file is JSON
// from its first byte to its last.

#pragma once

#include <cstddef>
#include <string>

#include "base/files/file.h"

namespace qchopper {

// Whether the bytes begin with "glTF", the magic number of a GLB.
bool is_glb(const Bytes& bytes);

// Where the JSON lies in the file, in bytes.
struct JsonChunk {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t end_of_file = 0;  // the length in the header of a GLB; bytes after it are ignored
    bool is_glb = false;
};

// Postcondition: begin <= end <= end_of_file <= bytes.size(). Throws InputError (mesh) for a GLB whose header or first
// chunk is wrong; `name` stands for the file in the message.
JsonChunk find_json(const Bytes& bytes, const std::string& name);

// The same GLB with another JSON, padded to a multiple of four bytes. Precondition: `old` is find_json(bytes) and
// old.is_glb.
Bytes with_json(const Bytes& bytes, const JsonChunk& old, std::string json);

}  // namespace qchopper
