// The passes that clear a region of one level of roughing: along the rim of where the tip may go, and in rows.
//
// mm, in the frame of the map. Every point of a pass is in the region. So is every cell under the line to the next one,
// but for corners of cells of which less than an eighth of a cell is passed, or the line passes at most `beside` from a
// way over neighbouring cells (tests/cam/toolpath/roughing_passes_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "cam/toolpath/pass.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// Per cell of a map, row by row.
struct LevelRegion {
    double cell = 1;  // mm
    std::size_t columns = 0;
    std::size_t rows = 0;
    CellMask is_allowed;  // the tip may be there
    CellMask is_wanted;   // it has something to do there; looked at where it is allowed
    double beside = 0;    // mm

    bool allowed(std::ptrdiff_t column, std::ptrdiff_t row) const { return is_in(is_allowed, column, row); }
    bool wanted(std::ptrdiff_t column, std::ptrdiff_t row) const {
        return allowed(column, row) && is_in(is_wanted, column, row);
    }

 private:
    bool is_in(const CellMask& cells, std::ptrdiff_t column, std::ptrdiff_t row) const {
        return column >= 0 && row >= 0 && static_cast<std::size_t>(column) < columns &&
               static_cast<std::size_t>(row) < rows &&
               cells[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] != 0;
    }
};

// At a height, with rows at most `step` apart. Every wanted cell that has a neighbour is at most half of the step and a
// cell from a pass. O(cells + points * length of the lines).
std::vector<Pass> roughing_passes(const LevelRegion& region, double height, double stepover);

}  // namespace qchopper
