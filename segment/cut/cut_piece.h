// Cuts a piece into the pieces that it falls into: every connected solid on both sides of the plane.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "segment/cut/piece.h"

namespace qchopper {

struct CutPieces {
    std::vector<Piece> pieces;  // unnamed; those above the plane first, then those below, each closed
    double cap_area_mm2 = 0;
    std::vector<std::string> warnings;  // where the input intersects itself
};

// Cuts exactly at plane.offset. Nothing if the plane misses the piece. Throws InputError if the piece is open.
std::optional<CutPieces> cut_piece(const Piece& piece, const Plane& plane, std::int32_t cut_number);

}  // namespace qchopper
