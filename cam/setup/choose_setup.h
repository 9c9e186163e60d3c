// Chooses the setup of a piece in a cell (setup.h): of every way to lay it, that which leaves least out of reach.
//
// Lengths in mm. A piece that is turned together with its half-spaces has the same bases, undercuts and blocks; what is
// reached of it differs by the direction set, which is fixed in the scan (tests/cam/setup/choose_setup_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/mapped_access.h"
#include "cam/setup/setup.h"
#include "segment/access/piece_access.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct SetupOptions {
    std::optional<int> base;  // number of the base that is taken (PieceBase::number); nothing: the best
    std::size_t max_directions = 8;
    std::optional<double> max_tilt_deg;  // nothing: that of the cell, or without a machine default_tilt_deg
    bool count_narrow = false;           // surface too narrow for the smallest tool is unreachable
    // Of the piece's surface. They choose directions and rank bases; the verdict is that of the height fields. Where
    // the samples themselves decide, a share of 2 % needs 4,000 (piece_access.h).
    std::size_t samples = 2000;
    // Piece::samples serve if they are as many. Only with mapped = 0 and without count_narrow, and then without states.
    bool takes_kept_samples = false;
    // So many of the best bases are judged by height fields if they are as good as the first, which always is. With 0
    // and without count_narrow, no surface is judged too narrow.
    std::size_t mapped = 2;
    HeightFieldOptions map;
    // Directions, in piece coordinates, that may be chosen beside straight up, of those that the cell holds; empty:
    // all.
    std::function<bool(Vec3)> is_allowed = {};
    // bases_of(piece), where it is known; null: it is worked out.
    std::shared_ptr<const std::vector<PieceBase>> bases = {};
};

// All ways to lay a piece, best first.
struct SetupChoice {
    std::vector<Setup> setups;         // at least one
    std::vector<SurfaceState> states;  // per triangle of the piece, in the first setup; empty if it is not mapped
};

// The largest tilt of the tool axis from the vertical, degrees: that of the cell, without a machine default_tilt_deg.
double max_tilt_deg(const Cell& cell);

// Ranked are, first of all, those whose block fits into the cell; then those whose workholding passes (workholding.h),
// unless they leave a larger share out of reach than the cell's max_unreachable and the setup that leaves least; then
// by the least unreachable share, the least foam that stays, the least rest material and the smallest block. Where
// blocks are sawn the unreachable area counts in place of the share, of the area of the whole piece, and then block and
// area to mill together (foam_per_milled_cap). With options.base that base is first. Preconditions: the mesh is closed
// and has triangles, half_space.up() are unit vectors, the cell has a block, and options.base is a number of
// bases_of(piece).
SetupChoice choose_setup(const Piece& piece, const Cell& cell, const SetupOptions& options = {});

// Whether some way to lay the piece fits into the cell, by boxes alone: the stop rule of that name. Far cheaper than
// choose_setup().
bool fits_cell(const Piece& piece, const Cell& cell);

// Whether in addition, for one of these ways, the machine holds the extreme poses of milling straight from above, along
// which every setup is milled, without a collision: the stop rule where the arm is known. Further directions are not
// chosen yet when it is asked; reachable_directions() asks the arm for each of them. The same as fits_cell() in a cell
// without a machine. `bases` are bases_of(piece). Throws as height_field() does.
bool fits_cell_and_machine(const Piece& piece, const Cell& cell, std::span<const PieceBase> bases);

}  // namespace qchopper
