// Chooses how a piece is held and oriented: which cap lies on the table, from which directions the tool comes, how the
// piece is turned, and the block it is carved from.
//
// Lengths in mm. Setup coordinates: z up, the piece's base plane (its lowest point, without a base) at z = 0, the
// underside of the block at z = -spoil, the block's middle and the middle of the piece's box at x = y = 0, x along the
// long side of the piece's smallest rectangle on the table. Turning a piece with caps together with its half-spaces
// changes neither undercut nor block (tests/cam/setup/setup_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cell.h"
#include "cam/setup/block.h"
#include "cam/setup/surface_reach.h"
#include "segment/cut/piece.h"
#include "segment/mesh/measure.h"

namespace qchopper {

struct Setup {
    int base_number = 0;               // as PieceBase::number: with what --base chooses it
    std::optional<std::int32_t> base;  // number of the cut whose cap lies on the table; none: the piece owns no cap
    std::string base_description;      // the same for people
    Vec3 up{0, 0, 1};                  // unit vector in piece coordinates
    Pose piece_in_setup;
    Box box;  // of the piece in setup coordinates

    double spoil = 0;  // thickness of the layer under the piece that stays on the table; 0 in a cell of version 1
    CarvingBlock block;

    SurfaceReach reach;             // what the tool reaches
    double undercut = 0;            // share of the projected area that faces down, base left out
    double undercut_by_count = 0;   // share of the triangles that face down, base left out
    double base_mm2 = 0;            // projected area of the base; 0 without one
    double projected_area_mm2 = 0;  // of the piece, along up
    std::vector<std::string> warnings;
    bool operator==(const Setup&) const = default;
};

struct SetupOptions {
    std::optional<int> base;  // number of the base that is taken (PieceBase::number); nothing: the best
    std::size_t max_directions = 8;
    std::optional<double> max_tilt_deg;  // nothing: that of the cell, or without a machine default_tilt_deg
    bool count_narrow = false;           // surface too narrow for the smallest tool is unreachable
    std::size_t samples = 4000;          // of the piece's surface, per piece
    // So many of the best bases are judged by height maps. With 0 and without count_narrow, no surface is judged too
    // narrow.
    std::size_t mapped = 2;
};

// All ways to lay a piece, best first.
struct SetupChoice {
    std::vector<Setup> setups;         // at least one
    std::vector<SurfaceState> states;  // per triangle of the piece, in the first setup; empty if it is not mapped
};

// Ranked are, first of all, those whose block fits into the cell; then by the least unreachable area, the least foam
// that stays, the least residue and the smallest block. With options.base that base is first. Preconditions: the mesh
// is closed and has triangles, half_space.up() are unit vectors, the cell has a block, and options.base is a number of
// bases_of(piece).
SetupChoice choose_setup(const Piece& piece, const Cell& cell, const SetupOptions& options = {});

// Whether some way to lay the piece fits into the cell, by boxes alone: the stop rule of that name. Far cheaper than
// choose_setup().
bool fits_cell(const Piece& piece, const Cell& cell);

}  // namespace qchopper
