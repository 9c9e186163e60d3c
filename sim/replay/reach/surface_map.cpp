// Ring by ring about the point (distance_to_cells). O(cells within the distance).

#include "sim/replay/reach/surface_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/replay/stock/dexel_map.h"

namespace qchopper {

double SurfaceMap::at(double x, double y) const {
    const auto i = static_cast<std::int32_t>(std::floor((x - x_min) / cell));
    const auto j = static_cast<std::int32_t>(std::floor((y - y_min) / cell));
    if (i < 0 || j < 0 || i >= columns || j >= rows) return no_surface;
    return height[static_cast<std::size_t>(j) * columns + i];
}

double SurfaceMap::highest_about(double x, double y) const {
    double highest = no_surface;
    for (const int j : {-1, 0, 1}) {
        for (const int i : {-1, 0, 1}) highest = std::max(highest, at(x + i * cell, y + j * cell));
    }
    return highest;
}

double SurfaceMap::distance_above(Vec3 point, double most) const {
    return distance_to_cells(point, x_min, y_min, cell, most, [&](std::int32_t i, std::int32_t j) {
        if (i < 0 || j < 0 || i >= columns || j >= rows) return std::numeric_limits<float>::infinity();
        return height[static_cast<std::size_t>(j) * columns + i];
    });
}

}  // namespace qchopper
