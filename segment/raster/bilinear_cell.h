// The four cells of a map between whose centres a point lies, and the linear surface over them.
//
// mm. A point beside the middles of the outermost cells counts as the nearest one that is not.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "segment/raster/height_field.h"

namespace qchopper {

struct BilinearCell {
    std::array<std::size_t, 4> cells{};  // indices: a row and the next column, then the same in the next row
    double column_share = 0;             // how far the point lies from the first column to the next, and from the
    double row_share = 0;                // first row to the next: 0..1

    // Precondition: the map has a cell. O(1).
    BilinearCell(const HeightField& map, double x, double y) {
        const double columns = std::clamp(x / map.cell - 0.5, 0.0, static_cast<double>(map.columns - 1));
        const double rows = std::clamp(y / map.cell - 0.5, 0.0, static_cast<double>(map.rows - 1));
        const auto column = static_cast<std::size_t>(columns);
        const auto row = static_cast<std::size_t>(rows);
        column_share = columns - static_cast<double>(column);
        row_share = rows - static_cast<double>(row);
        const std::size_t next_column = std::min(column + 1, map.columns - 1);
        const std::size_t next_row = std::min(row + 1, map.rows - 1);
        cells = {row * map.columns + column, row * map.columns + next_column, next_row * map.columns + column,
                 next_row * map.columns + next_column};
    }

    double height(const HeightField& map) const {
        const auto z = [&](std::size_t k) { return static_cast<double>(map.height[cells[k]]); };
        return (1 - row_share) * ((1 - column_share) * z(0) + column_share * z(1)) +
               row_share * ((1 - column_share) * z(2) + column_share * z(3));
    }
};

}  // namespace qchopper
