// Lays a piece on one of its bases in its block, before anything is asked of the tool.
//
// Lengths in mm. The piece stands on z = 0 in the middle of its block, or against faces of it in which its caps lie
// (tests/cam/setup/flush_caps_test.cpp, choose_setup_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "cam/setup/layout/flush_caps.h"
#include "cam/setup/setup.h"
#include "segment/access/piece_access.h"
#include "segment/cut/piece.h"

namespace qchopper {

// The caps of a piece that may be faces of a block of the cell: none where no block may be sawn. O(triangles).
std::vector<CapPoints> caps_to_saw(const TriangleMesh& mesh, const Cell& cell);

// The setup without directions: pose, block and flush caps. Of the turns that turns_to_try() gives the first whose
// block fits into the cell, turned by a quarter where it fits only so; of none that fits the first. `caps` are those of
// caps_to_saw(). Preconditions as in choose_setup().
Setup lay_out(const Piece& piece, const PieceBase& base, const Cell& cell, std::span<const CapPoints> caps);

}  // namespace qchopper
