// A mesh as a file holds it, in the file's own unit, before anything is welded, shifted or scaled.

#pragma once

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
    gltf,  // JSON, with its numbers in other files or inside
    glb,   // all in one
    three_mf
};

// "PLY, binary little-endian"
std::string name_of(MeshFormat format);

struct RawMesh {
    TriangleMesh mesh;  // an STL file names three points of its own per triangle; cap_of comes from a PLY face property
    MeshFormat format = MeshFormat::ply_ascii;
    std::size_t faces_in_file = 0;       // polygons count once
    std::size_t faces_without_area = 0;  // with fewer than three corners: left out
    std::optional<double> mm_per_unit;   // what the file itself says one unit is; nothing: the format has none
    std::vector<std::string> warnings;   // what was left out, in whole sentences for the operator
    std::size_t welded = 0;              // points that the reader made one with an equal earlier one
    std::vector<Sha256> beside;          // of the files beside it that hold a part of it (glTF), in its order
};

struct ReadOptions {
    // Equal points of a binary STL file become one as they are read, which saves most of the memory: to be followed by
    // weld(), which then has the same result.
    bool weld = false;
};

}  // namespace qchopper
