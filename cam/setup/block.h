// Chooses the block for a piece as it lies: from the list of stock, whole or sawn down.
//
// mm, setup coordinates. The block that is chosen holds the piece with its margins whenever one of the list does
// (tests/cam/setup/block_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/block_face.h"

namespace qchopper {

// Foam around a piece: that of the cell file, with a spoil layer that the tools of the machine do not cut through.
Margins margins_of(const Cell& cell);

// Foam that is kept at each face, by BlockFace, at least: none where it is flush.
std::array<double, block_faces> foam_at_faces(const Margins& margins, const FlushFaces& flush);

// What a piece of a size needs with that foam and its spoil layer.
Vec3 size_with_foam(Vec3 piece_size, const Margins& margins, const FlushFaces& flush);

struct StockBlock {
    std::size_t stock = 0;      // index in Cell::stock
    bool is_turned = false;     // by a quarter turn about z: the listed x lies along y; a sawn one is never turned
    bool is_sawn = false;       // down to `size`
    Vec3 size;                  // as it stands, spoil layer included
    bool holds = true;          // false: no block of the list holds the piece with its margins; this one lacks least
    std::vector<Vec3> offcuts;  // of a sawn block: sizes of what is left of it, largest first
    bool operator==(const StockBlock&) const = default;
};

// A square metre of cap to mill costs as much machine time as 400 litres of foam to mill off: 2.13 h a square metre and
// 0.0053 h a litre, fitted to the programs of the 52 pieces of a bunny of 1.5 m in two cells
// (docs/measurements/proof.md).
constexpr double foam_per_milled_cap = 400;  // mm

constexpr double flush_step = 0.1;  // mm, of sizes along an axis with a flush face

// For a piece of a size (x along its length), of the blocks that hold it: the one of least volume, where a saw cut
// counts as 20 l; of equal ones the first of the list. Stock that may be sawn is sawn down to the piece, in an
// orientation in which nothing need be sawn off or else the largest offcut is left.
StockBlock choose_block(const Cell& cell, Vec3 piece_size);

// The same with flush faces. `caps_mm2`: by BlockFace, the area of the caps in whose plane the block can end; 0: none.
// Such a face is sawn in every case, so that stock must be longer by a saw cut for each; where it is not, the faces
// along that axis are as others. Then saw cuts cost nothing, and caps that are milled their area times
// foam_per_milled_cap. Along an axis with a flush face the size is in tenths of mm, rounded up in x and y and to the
// nearest one in z, else in whole mm.
struct FlushBlock {
    StockBlock block;
    FlushFaces flush{};  // of the faces that caps lie in, those for which the stock is long enough
};
FlushBlock choose_flush_block(const Cell& cell, Vec3 piece_size, const std::array<double, block_faces>& caps_mm2);

}  // namespace qchopper
