// Finds the JSON of a glTF file, and reduces it to what describes triangles, with every value of the type that it must
// have.
//
// A glTF file is JSON from its first byte to its last, a GLB a header, a chunk of JSON and a chunk of numbers.
// tinygltf, which reads the result, neither checks the types of values nor limits the depth of nested "extras"; here
// types are checked and extras are left out (tests/segment/io/damaged_test.cpp,
// tests/segment/io/formats/read_gltf_test.cpp).

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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

struct PlainGltf {
    std::string json;
    std::vector<std::string> warnings;  // what was left out, one sentence each
};

// `has_bin`: the JSON is that of a GLB, whose first buffer follows it in the file. `name` stands for the file in
// messages. Throws InputError (mesh) for JSON that is damaged or no glTF of version 2, and for a file that requires an
// extension which is not read.
PlainGltf plain_gltf(std::string_view json, bool has_bin, const std::string& name);

}  // namespace qchopper
