// Lines of constant height of a CL surface.
//
// mm, in the map. The surface is linear between neighbouring centres of cells, but where it falls so far that an edge
// may lie between them, all of the fall is at the lower one, or, where the edge is known, in front of it by at most a
// sixteenth of a cell. On the left of a line the surface is not above it.

#pragma once

#include <cstddef>
#include <vector>

#include "cam/stock/cl_surface_view.h"
#include "cam/stock/edge_rises.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

struct WaterlinePoint {
    Point2 at;
    bool is_at_edge = false;        // all of the fall is here, up to a cell's width beside where the edge is
    bool is_at_found_edge = false;  // all of the fall is here, and so is the edge
    bool operator==(const WaterlinePoint&) const = default;
};

struct Waterline {
    std::size_t level = 0;
    // At least two, no two neighbours the same; of a closed line the first is not repeated.
    std::vector<WaterlinePoint> points;
    bool is_closed = false;
};

// Levels begin at a height and are `step` apart.
struct Levels {
    double first = 0;
    double step = 1;
    double height(std::size_t level) const { return first + step * static_cast<double>(level); }
};

// `edges`, if there are any, are those of the surface with the same mask and jump.
// The lines of all levels whose number is `remainder` modulo `divisor`, where a square of four centres begins at a cell
// of the mask; by level, and otherwise in an order that depends on the map alone. Preconditions: no level of the
// surface in the mask is below the first one, step > 0, divisor > remainder. O(squares + crossings * log(crossings)).
std::vector<Waterline> waterlines(const HeightField& cl, const CellMask& mask, const Levels& levels,
                                  std::size_t divisor, std::size_t remainder, double jump,
                                  const EdgeRises* edges = nullptr);

}  // namespace qchopper
