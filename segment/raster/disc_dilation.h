// The highest cell of a map within a distance of each cell.
//
// mm. Distances are from centre to centre; cells beside the map count as `nothing`. The result does not depend on the
// number of threads (tests/cam/stock/in_process_stock_test.cpp).

#pragma once

#include <cstddef>
#include <limits>

#include "segment/raster/height_field.h"

namespace qchopper {

// Cells lower than `from` may be left out: what is found may then be lower than it is, but only below `from`.
// Precondition: radius >= 0. O(cells * radius / cell) of the rows that have cells from there on, one further map.
HeightField dilate_by_disc(const HeightField& map, double radius, float from = HeightField::nothing);

// The same at one place of the map, given in mm: of the cells whose centres lie within the radius of it, at least of
// the one that it lies in. O((radius / cell)^2).
float dilation_at(const HeightField& map, double x, double y, double radius);

// Whether that is above a height.
bool is_dilation_above(const HeightField& map, double x, double y, double radius, double height);

// Raises tips to where a disc that is `above` them is clear of a map with the same cells: to the dilation less that.
// Tips below `lowest` may be lower. Cost as of dilate_by_disc.
void raise_over_disc(HeightField& tip, const HeightField& map, double radius, double above,
                     double lowest = -std::numeric_limits<double>::infinity());

// Which cells have a marked one within so many cells: where dilate_by_disc() of 1 for marked cells and 0 for others
// is 1. Preconditions: one mark per cell, row by row; cells >= 0. O(rows * columns / 64 * cells).
CellMask marked_within(const CellMask& marks, std::size_t columns, std::size_t rows, double cells);

}  // namespace qchopper
