// Chooses the block for a piece as it lies: from the list of stock, whole or sawn down.
//
// mm. The block that is chosen holds the piece with its margins whenever one of the list does
// (tests/cam/setup/block_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// Foam around a piece: that of the cell file, with a spoil layer that the tools of the machine do not cut through.
Margins margins_of(const Cell& cell);

struct StockBlock {
    std::size_t stock = 0;      // index in Cell::stock
    bool is_turned = false;     // by a quarter turn about z: the listed x lies along y; a sawn one is never turned
    bool is_sawn = false;       // down to `size`
    Vec3 size;                  // as it stands, spoil layer included
    bool holds = true;          // false: no block of the list holds the piece with its margins; this one lacks least
    std::vector<Vec3> offcuts;  // of a sawn block: sizes of what is left of it, largest first
    bool operator==(const StockBlock&) const = default;
};

// For a piece of a size (x along its length), of the blocks that hold it: the one of least volume, where a saw cut
// counts as 20 l; of equal ones the first of the list. Stock that may be sawn is sawn down to the piece, in an
// orientation in which nothing need be sawn off or else the largest offcut is left.
StockBlock choose_block(const Cell& cell, Vec3 piece_size);

}  // namespace qchopper
