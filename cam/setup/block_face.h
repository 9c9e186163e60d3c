// The faces of a block as it stands, but for its underside, and which of them are sawn in the planes of caps.
//
// mm, setup coordinates (setup.h). Tests: tests/cam/setup/flush_caps_test.cpp, saw_cuts_test.cpp.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/box.h"
#include "base/enum_names.h"

namespace qchopper {

enum class BlockFace : std::uint8_t { minus_x, plus_x, minus_y, plus_y, top };
constexpr std::size_t block_faces = 5;

constexpr auto names_of(BlockFace) {
    return EnumNames<BlockFace, block_faces>{{{BlockFace::minus_x, "-x"},
                                              {BlockFace::plus_x, "+x"},
                                              {BlockFace::minus_y, "-y"},
                                              {BlockFace::plus_y, "+y"},
                                              {BlockFace::top, "top"}}};
}

// Faces of a block that are sawn in the planes of caps, by BlockFace: no foam is kept there.
using FlushFaces = std::array<bool, block_faces>;

// How far inside of each face of a box a point lies, by BlockFace; negative: beyond it.
inline std::array<double, block_faces> inside_faces(const Box& box, Vec3 p) {
    return {p.x - box.min.x, box.max.x - p.x, p.y - box.min.y, box.max.y - p.y, box.max.z - p.z};
}

}  // namespace qchopper
