// Chooses how a piece is held and oriented: which cap lies on the table, how it is turned, and the block it is carved
// from.
//
// Lengths in mm. Setup coordinates: z up, the underside of the block and the lowest point of the piece at z = 0, the
// block's middle and the middle of the piece's box at x = y = 0, x along the long side of the piece's smallest
// rectangle on the table. Turning a piece with caps together with its half-spaces changes neither undercut nor block
// (tests/cam/setup/setup_test.cpp).

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
    std::string base_description;      // the same for people
    Vec3 up{0, 0, 1};                  // unit vector in piece coordinates
    Pose piece_in_setup;
    Box box;  // of the piece in setup coordinates

    std::size_t stock = 0;      // index in Cell::stock
    bool stock_turned = false;  // by a quarter turn about z: its listed x lies along y
    Vec3 block;                 // size of the block as it stands
    bool stock_holds = true;    // false: no block of the list holds the piece with its margin; this one lacks least

    double undercut = 0;             // share of the projected area that faces down, base left out
    double occluded_area_ratio = 0;  // share of the area that no vertical ray reaches, base left out
    double base_mm2 = 0;             // projected area of the base; 0 without one
    double projected_area_mm2 = 0;   // of the piece, along up
    bool base_is_stable = true;      // the base is at least a tenth of the projected area
    std::vector<std::string> warnings;
    bool operator==(const Setup&) const = default;
};

// The base is the cap with the least undercut, of several that tie the one of the lowest cut; a cap that is not stable
// is taken only if none is. A piece without caps lies on the side of its oriented box for which the least area is
// occluded. The stock is the smallest block that holds the piece with its margin. Preconditions: the mesh is closed and
// has triangles, half_space.up() are unit vectors, and the cell has a block.
Setup choose_setup(const Piece& piece, const Cell& cell);

}  // namespace qchopper
