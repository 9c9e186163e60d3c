// Reads a scan from a file as it stands: nothing is welded, shifted or scaled. PLY, STL, OBJ, OFF, glTF, GLB and 3MF.
//
// Coordinates are in the file's own unit with Z up; docs/formats.md says what is read of each format. The format is
// told by the content, never by the name. Whatever the bytes, the answer is a mesh with finite coordinates and valid
// indices or an InputError (mesh) that says what is wrong and at which line or byte
// (tests/segment/io/read_mesh_test.cpp, tests/segment/io/damaged_test.cpp).

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file.h"
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

// The bytes of a scan; "-" is standard input, to its end. Throws InputError (missing) if they cannot be read.
Bytes read_scan(const std::filesystem::path& path);

// Throws InputError (missing) for a file that cannot be read, (mesh) for one that is wrong.
RawMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from bytes in memory; `name` stands for the file in errors. Only a glTF file looks for others, in `folder`;
// without a folder it is refused if it has any.
RawMesh parse_mesh(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder = {},
                   const ReadOptions& options = {});

// The name and the folder to give to parse_mesh for the file at `path`.
std::string name_of_scan(const std::filesystem::path& path);
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace qchopper
