// A CL surface looked at with rows along either of its axes, and masks of its cells.
//
// mm, cells of the map.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "segment/raster/height_field.h"

namespace qchopper {

// What is to be finished, and the cells beside it over which passes may go as well.
struct PassCells {
    CellMask wanted;
    CellMask allowed;
};

class ClSurfaceView {
 public:
    ClSurfaceView(const HeightField& map, bool is_turned) : map_(&map), is_turned_(is_turned) {}

    double cell() const { return map_->cell; }
    std::size_t columns() const { return is_turned_ ? map_->rows : map_->columns; }
    std::size_t rows() const { return is_turned_ ? map_->columns : map_->rows; }
    std::size_t index(std::size_t column, std::size_t row) const {
        return is_turned_ ? column * map_->columns + row : row * map_->columns + column;
    }
    double at(std::size_t column, std::size_t row) const {
        return static_cast<double>(map_->height[index(column, row)]);
    }
    // Along the row, by central differences; at the border one-sided.
    double slope_along(std::size_t column, std::size_t row) const {
        const std::size_t before = column > 0 ? column - 1 : column;
        const std::size_t after = std::min(column + 1, columns() - 1);
        if (after == before) return 0;
        return (at(after, row) - at(before, row)) / (cell() * static_cast<double>(after - before));
    }
    double slope_across(std::size_t column, std::size_t row) const {
        return ClSurfaceView(*map_, !is_turned_).slope_along(row, column);
    }
    // The centre of a cell at some height, in the map.
    Vec3 point(double column, double row, double z) const {
        const double u = (column + 0.5) * cell();
        const double v = (row + 0.5) * cell();
        return is_turned_ ? Vec3{v, u, z} : Vec3{u, v, z};
    }

 private:
    const HeightField* map_;
    bool is_turned_;
};

}  // namespace qchopper
