// Into how many pieces one that is too large for every block must be cut at least: by boxes alone.
//
// mm. A piece that, as it lies, has no larger box than one of usable_blocks() fits into the cell where choose_block()
// takes that block (tests/cam/setup/blocks_needed_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// What each block of the cell holds at most, margins and spoil layer taken off, z up: of the blocks that stand within
// its reach and on its table, a sawn one in all the ways it can be sawn. No box of the list fits in another.
// O(stock^2).
std::vector<Vec3> usable_blocks(const Cell& cell);

// The same of the blocks that are no higher than the longest tool is long, so that holder and spindle stay above the
// block wherever the tip stands in it. Without a machine all of usable_blocks().
std::vector<Vec3> low_usable_blocks(const Cell& cell);

// The largest height of a piece above its base in one of them; infinite without a machine.
double low_piece_height(const Cell& cell);

// The least number of equal boxes of one of these sizes, in any order of the axes, into which planes along its axes
// divide a box (segment/mesh/boxes_needed.h). Infinite without blocks. O(blocks).
double blocks_needed(std::span<const Vec3> usable, Vec3 size);

}  // namespace qchopper
