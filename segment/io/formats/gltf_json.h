// Reduces the JSON of a glTF file to what describes triangles, with every value of the type that it must have.
//
// tinygltf, which reads the result, neither checks the types of values nor limits the depth of nested "extras"; here
// types are checked and extras are left out (tests/segment/io/damaged_test.cpp,
// tests/segment/io/formats/read_gltf_test.cpp).

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace qchopper {

struct PlainGltf {
    std::string json;
    std::vector<std::string> warnings;  // what was left out, one sentence each
};

// `has_bin`: the JSON is that of a GLB, whose first buffer follows it in the file. `name` stands for the file in
// messages. Throws InputError (mesh) for JSON that is damaged or no glTF of version 2, and for a file that requires an
// extension which is not read.
PlainGltf plain_gltf(std::string_view json, bool has_bin, const std::string& name);

}  // namespace qchopper
