// The highest cell of a map within a distance of each cell.
//
// mm. Distances are from middle to middle; cells beside the map count as `nothing`. The result does not depend on the
// number of threads (tests/cam/stock/in_process_stock_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/raster/height_map.h"

namespace qchopper {

// Precondition: radius >= 0. O(cells * radius / cell), one further map.
HeightMap disc_max(const HeightMap& map, double radius);

// The same at one place of the map, given in mm: of the cells whose middles lie within the radius of it, at least of
// the one that it lies in. O((radius / cell)^2).
float disc_max_at(const HeightMap& map, double x, double y, double radius);

// Whether that is above a height.
bool is_disc_above(const HeightMap& map, double x, double y, double radius, double height);

// Which cells have a marked one within so many cells: where disc_max() of 1 for marked cells and 0 for others is 1.
// Preconditions: one mark per cell, row by row; cells >= 0. O(rows * columns / 64 * cells).
std::vector<std::uint8_t> marked_within(const std::vector<std::uint8_t>& marks, std::size_t columns, std::size_t rows,
                                        double cells);

}  // namespace qchopper
