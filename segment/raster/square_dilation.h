// Dilation of masks and erosion of heights by a square of cells.
//
// The square reaches `by` cells from its middle along rows and columns. Row by row; the result does not depend on the
// number of threads (tests/cam/toolpath/finishing_region_test.cpp). O(cells * log by).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/raster/height_field.h"

namespace qchopper {

// Per cell the largest byte of the mask in the square around it.
CellMask dilate_by_square(CellMask mask, std::size_t columns, std::size_t rows, std::size_t by);

// Per cell the lowest height in the square around it, as far as that lies in the grid.
std::vector<float> erode_by_square(std::vector<float> heights, std::size_t columns, std::size_t rows, std::size_t by);

}  // namespace qchopper
