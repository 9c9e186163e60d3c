// The highest cell of a map within a distance of each cell.
//
// mm. Distances are from middle to middle; cells beside the map count as `nothing`. The result does not depend on the
// number of threads (tests/cam/toolpath/in_process_stock_test.cpp).

#pragma once

#include "cam/setup/height_map.h"

namespace qchopper {

// Precondition: radius >= 0. O(cells * radius / cell), one further map.
HeightMap disc_max(const HeightMap& map, double radius);

// The same at one place of the map, given in mm: of the cells whose middles lie within the radius of it, at least of
// the one that it lies in. O((radius / cell)^2).
float disc_max_at(const HeightMap& map, double x, double y, double radius);

}  // namespace qchopper
