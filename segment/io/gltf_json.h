// The JSON of a glTF file cut down to what makes triangles, with every value of the type that it must have.
//
// What goes on to the library then holds no pictures, no notes and no surprises: it reads numbers without asking
// whether they are any, and follows nested notes as deep as they go (tests/segment/io/damaged_test.cpp).

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace qchopper {

struct PlainGltf {
    std::string json;
    std::vector<std::string> warnings;  // what was left out
};

// `has_bin`: it is that of a GLB, whose first buffer follows it. Throws InputError (mesh) for JSON that is damaged, and
// for files that need an extension which is not read.
PlainGltf plain_gltf(std::string_view json, bool has_bin, const std::string& name);

}  // namespace qchopper
