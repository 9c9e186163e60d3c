// Reads the header of a PLY file: which elements follow, and how each of their properties is stored.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "segment/io/formats/raw_mesh.h"

namespace qchopper {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

// Bytes of one value in a binary body.
std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
    return type != PlyType::f32 && type != PlyType::f64;
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;
    bool is_list = false;
    PlyType count_type = PlyType::u8;  // of a list; an integer type
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t line = 0;  // of its line in the header, from 1
};

struct PlyHeader {
    MeshFormat format = MeshFormat::ply_ascii;
    std::vector<PlyElement> elements;  // at most 100, each name once
    std::size_t size = 0;              // bytes of the header: where the body begins
    std::size_t lines = 0;             // of the header
};

// The first line is not checked (is_ply() does that). Throws InputError (mesh) with the line of the fault; `name`
// stands for the file.
PlyHeader read_ply_header(std::string_view file, const std::string& name);

}  // namespace qchopper
