// Parts of a map, squares of cells, in which something is computed while the rest of the map is left out.
//
// Tiles lie side by side from the first cell on; the last of a row and of a column may be narrower. Several threads may
// call add() at the same time (tests/segment/raster/field_tiles_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/raster/cells_under.h"
#include "segment/raster/height_field.h"

namespace qchopper {

class FieldTiles {
 public:
    static constexpr std::size_t side = 16;  // cells

    // None of a map with so many cells.
    FieldTiles(std::size_t columns, std::size_t rows);

    // The tile that holds a cell.
    void add(std::size_t cell);

    // All tiles that have a cell within so many columns and rows of a cell of these. O(tiles * log cells).
    FieldTiles grown(std::size_t cells) const;

    // The tiles of both. Precondition: the maps are as large.
    FieldTiles common(const FieldTiles& other) const;

    bool holds(std::size_t cell) const { return marked_[tile_of(cell)] != 0; }
    bool is_empty() const;

    // The cells of a row that are in tiles, in their order; no two spans touch. O(tiles of a row).
    std::vector<CellSpan> spans(std::size_t row) const;

 private:
    std::size_t tile_of(std::size_t cell) const {
        return cell / columns_ / side * tile_columns_ + cell % columns_ / side;
    }

    std::size_t columns_;
    std::size_t tile_columns_;
    std::size_t tile_rows_;
    CellMask marked_;
};

}  // namespace qchopper
