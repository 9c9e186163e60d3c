// Holds a mesh as a file contains it, in the unit of the file, before it is welded, shifted or scaled.

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/sha256.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class MeshFormat {
    ply_ascii,
    ply_little_endian,
    ply_big_endian,
    stl_ascii,
    stl_binary,
    obj,
    off,
    gltf,  // JSON, with its buffers in other files or inside
    glb,   // JSON and buffers in one file
    three_mf
};

// "PLY, binary little-endian"
inline std::string name_of(MeshFormat format) {
    constexpr std::array names{"PLY, ASCII",
                               "PLY, binary little-endian",
                               "PLY, binary big-endian",
                               "STL, ASCII",
                               "STL, binary",
                               "OBJ",
                               "OFF",
                               "glTF",
                               "GLB",
                               "3MF"};  // in the order of MeshFormat
    static_assert(names.size() == static_cast<std::size_t>(MeshFormat::three_mf) + 1);
    return names.at(static_cast<std::size_t>(format));
}

// The formats that are read, for help texts and messages.
constexpr const char* mesh_formats = "PLY, STL, OBJ, OFF, glTF, GLB or 3MF";

// What to do about a damaged file.
constexpr const char* export_again = "export or copy the file again";

// As the readers return it: coordinates are finite, corners are indices of points, cap_of is empty or one per triangle
// (tests/segment/io/damaged_test.cpp).
struct RawMesh {
    TriangleMesh mesh;  // of an STL file three points per triangle; cap_of is the face property `cap` of a PLY
    MeshFormat format = MeshFormat::ply_ascii;
    std::size_t faces_in_file = 0;       // polygons count once
    std::size_t faces_without_area = 0;  // with fewer than three corners: left out
    std::optional<double> mm_per_unit;   // of the unit that the file states; nothing: the format has none
    std::vector<std::string> warnings;   // what was left out, one sentence each, for the operator
    std::size_t welded = 0;              // points that the reader replaced by an equal earlier one
    std::vector<Sha256> beside;          // of the buffer files of a glTF, in the order of reading
};

struct ReadOptions {
    // Equal points of a binary STL file become one as they are read, which saves most of the memory. weld() must follow
    // and then has the same result; the readers of other formats ignore it.
    bool weld = false;
};

}  // namespace qchopper
