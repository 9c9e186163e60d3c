// Cuts a piece into new pieces: every connected solid on either side of the plane.
//
// mm. Precondition: that of cut.h. The pieces are closed, and their volumes add up to that of the piece to 1e-9
// relative (tests/segment/cut/cut_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "segment/cut/cut.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct CutPieces {
    std::vector<Piece> pieces;  // two or more, without names; those above the plane first, then those below
    // One list per piece, one entry per triangle: the triangle of the cut piece of which it is a part; caps: no_parent.
    std::vector<std::vector<std::uint32_t>> parent;
    double cap_area_mm2 = 0;            // as in CutHalves
    std::vector<std::string> warnings;  // one if the piece intersects itself at the plane
};

// Cuts exactly at plane.offset. Nothing if the plane misses the piece. Throws InputError (mesh) if the piece is open
// where the plane passes. O(triangles + c log c) for c crossed triangles.
std::optional<CutPieces> cut_piece(const Piece& piece, const Plane& plane, std::int32_t cut_number);

}  // namespace qchopper
