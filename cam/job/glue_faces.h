// The faces of a block that are glue faces, with the pieces that are glued to them, and which of them are touched off.
//
// mm. Setup sheet, saw list and reports take them from here (tests/cam/job/glue_faces_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cam/job/job_cap.h"
#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A face of the block that is sawn in the plane of at least one cap.
struct GlueFace {
    BlockFace face = BlockFace::top;
    std::vector<std::int32_t> cuts;  // whose caps lie in it, ascending
    double area_mm2 = 0;             // of these caps
    // Names of the pieces that are glued to it, in the order of `caps`; empty where it is joined to none.
    std::vector<std::string> neighbours;
    bool operator==(const GlueFace&) const = default;
};

// By BlockFace. `caps` are those of the job. O(flush caps x joints).
std::vector<GlueFace> glue_faces(const Setup& setup, std::span<const JobCap> caps);

// The pieces that are glued to the base, in the order of `caps`.
std::vector<std::string> neighbours_at_base(const Setup& setup, std::span<const JobCap> caps);

// "B, C", or "no piece".
std::string list_of_pieces(const std::vector<std::string>& names);

// Foam from the piece's box to the faces of the block, by BlockFace.
std::vector<double> foam_around(const Setup& setup);

// Which faces the base frame is touched off from: the largest at the side, and the largest at right angles to it; of
// equal ones the first by BlockFace. A face opposite of one of them is not touched: it takes the error of the size.
struct TouchFaces {
    std::optional<BlockFace> first;
    std::optional<BlockFace> second;  // only where there is a first one
};
TouchFaces touch_faces(const Setup& setup);

// 0 to 2 for x, y and z: the axis that crosses a face, and at which end of it the face lies.
constexpr std::size_t axis_of(BlockFace face) {
    return static_cast<std::size_t>(face) / 2;
}
constexpr bool is_at_max(BlockFace face) {
    return face == BlockFace::plus_x || face == BlockFace::plus_y || face == BlockFace::top;
}

// Whether the block is cut from its stock at all: down to its size, or at a glue face.
bool is_sawn_down(const Setup& setup);

// Whether the saw alone makes the piece: every triangle belongs to its base or to a face of the block that holds it.
// Such a piece has no job. O(triangles).
bool is_only_sawn(const Setup& setup, const TriangleMesh& mesh);

}  // namespace qchopper
