// The foam that stands after what has been carved so far, from any of the directions.
//
// mm. It is the block less, for each direction, all above a height of its own map: along a direction carving removes
// only what lies open above. Conservative: a point that may still be foam counts as foam
// (tests/cam/toolpath/in_process_stock_test.cpp), so that there is never more foam in the way than is known; it may be
// up to three cells more than there is.

#pragma once

#include <cstddef>
#include <vector>

#include "base/vec3.h"
#include "cam/cell/carving_tool.h"
#include "cam/setup/height_map.h"
#include "cam/setup/setup.h"

namespace qchopper {

// Lowers a map, whose cells tell how high foam stands, by the tool on a straight way of its tip, in map coordinates. A
// cell is lowered only if all of it lies under the tool, and to the highest point of the tool over it. `slack`: how far
// the tool may pass beside the way, because a controller rounds corners. O(length / cell * (radius / cell)^2).
void sweep(HeightMap& map, const CarvingTool& tool, Vec3 from, Vec3 to, double slack = 0);

class InProcessStock {
 public:
    // The whole block. The setup must outlive it.
    explicit InProcessStock(const Setup& setup);

    // The highest foam along a direction over each whole cell of `frame`, whose heights are not looked at; `nothing`
    // where there is none. The frame is a map of that direction (target_map()); all frames have cells of one size.
    // O(cells * depth / cell * directions) at most; a ray ends at the first foam.
    HeightMap highest(std::size_t direction, const HeightMap& frame) const;

    // All above the heights of a map of a direction is gone: infinite where nothing was removed. The maps of one
    // direction must have the same cells.
    void remove_above(std::size_t direction, const HeightMap& map);

    // Whether a point in setup coordinates may be foam. O(directions).
    bool may_be_foam(Vec3 point) const;

 private:
    struct Removed {
        std::size_t direction = 0;
        HeightMap down_to;
    };
    const Setup* setup_;
    std::vector<Removed> removed_;
};

}  // namespace qchopper
