// How a CL surface rises between the centres of two neighbouring cells where there is an edge between them;
// edge_rises.cpp says why that is asked.
//
// mm, in the map.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cam/stock/cl_surface.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

// From the centre of a cell to that of the next one of its row or column. Its number is twice that of the cell, and one
// more if it runs along a column.
struct CellSide {
    std::size_t cell;
    std::size_t next;
    Point2 from;
    Point2 to;

    CellSide(const HeightField& tip, std::uint64_t number);
    Point2 at(double share) const { return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)}; }
};

class EdgeRises {
 public:
    // Of the sides, with a rise above `jump`, of all squares of four centres that begin at a cell of the mask. `tool`
    // is what the surface was made with; it may have been raised since, by holder or foam. The map must outlive it. On
    // several threads; the result does not depend on them. O(cells + sides * (radius / cell)^2), 72 bytes a side.
    EdgeRises(const HeightField& tip, const CellMask& mask, double jump, const ToolDilation& tool);

    // How far from its lower end, as a share in steps of a sixteenth, the surface over a side is not above a height
    // that lies between those of its ends. Nothing if its higher end is not where the tool alone asks for it.
    // O(log sides of its row).
    std::optional<double> share_below(std::uint64_t side, double z) const;

 private:
    static constexpr std::size_t steps = 16;

    // The highest so far at the steps from the lower end on, but for the first and the last: as far as it lies below
    // the higher end. False if the edge is not the tool's.
    bool rise_along(std::uint64_t side, const ToolDilation& tool, float* rise) const;

    const HeightField& tip_;
    std::vector<std::uint64_t> sides_;       // ascending
    std::vector<std::size_t> first_of_row_;  // in sides_, of each row of cells, and the end
    std::vector<std::uint8_t> is_known_;
    std::vector<float> rises_;  // steps - 1 of each side
};

}  // namespace qchopper
