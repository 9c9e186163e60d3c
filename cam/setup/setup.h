// How a piece is held and oriented: which cap lies on the table, how it is turned, and the block it is carved from.
//
// Lengths are millimetres. Setup coordinates: z up, the underside of the block and the lowest point of the piece at
// z = 0, the block's middle and the middle of the piece's box at x = y = 0, x along the piece's long side. Turning
// piece and bounds together changes neither undercut nor block (tests/cam/setup/setup_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cell.h"
#include "segment/cut/piece.h"
#include "segment/mesh/measure.h"

namespace qchopper {

struct Setup {
    std::optional<std::int32_t> base;  // number of the cut whose cap lies on the table; none: the piece owns no cap
    std::string base_words;            // the same for people
    Vec3 up{0, 0, 1};                  // in piece coordinates
    Pose piece_in_setup;
    Box box;  // of the piece in setup coordinates

    std::size_t stock = 0;      // index in Cell::stock
    bool stock_turned = false;  // the block stands a quarter turn about z: its listed x lies along y
    Vec3 block;                 // size of the block as it stands
    bool stock_holds = true;    // false: no block of the list holds the piece with its margin; this one comes nearest

    double undercut = 0;             // share of the projected area that faces down, base left out
    double occluded_area_ratio = 0;  // share of the area that no vertical tool sees, base left out
    double base_mm2 = 0;             // area of the base; 0 without
    double projected_area_mm2 = 0;   // area of the piece seen from above
    bool base_is_stable = true;      // the base is at least a tenth of the projected area
    std::vector<std::string> warnings;
    bool operator==(const Setup&) const = default;
};

// The base with the least undercut; a tie goes to the lower cut; one that is not stable is taken only if
// none can. A piece without caps takes the side of its oriented box from which least surface is occluded.
Setup choose_setup(const Piece& piece, const Cell& cell);

}  // namespace qchopper
