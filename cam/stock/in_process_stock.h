// The foam that stands after what has been milled so far, from any of the directions.
//
// mm. It is the block less, for each direction, all above a height of its own map: along a direction milling removes
// only what lies open above. Conservative: a point that may still be foam counts as foam
// (tests/cam/stock/in_process_stock_test.cpp), so that there is never more foam in the way than is known; it may be
// up to three cells more than there is. For what a flute has to cut at once that is too much beside a wall: foam can be
// known at the centres of cells instead, where it is right to within a cell of the other directions.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "cam/cell/cutting_tool.h"
#include "cam/setup/setup.h"
#include "segment/raster/height_field.h"

namespace qchopper {

enum class StockCells : std::uint8_t { whole, centres };  // what a height speaks for

// Lowers maps, whose cells tell how high foam stands, by a tool on its way. A whole cell is lowered only if all of it
// lies under the tool, and to the highest point of the tool over it.
class ToolSweep {
 public:
    // For maps of a cell size. `slack`: how far the tool may pass beside its way, because a controller rounds corners.
    ToolSweep(const CuttingTool& tool, double cell, double slack = 0, StockCells kind = StockCells::whole);

    // Along a straight line of the tip, in map coordinates, in two maps with the same cells. By how much it lowers the
    // first one, in mm3. O(cells passed), but for tools other than balls on a slope
    // O(length / cell * (radius / cell)^2).
    double move(HeightField& map, HeightField& other, Vec3 from, Vec3 to) const;

 private:
    // Precondition: the tool is a ball or the line is level.
    double sweep(HeightField& map, HeightField& other, Vec3 from, Vec3 to) const;

    double cell_;
    double outer_;  // farthest centre of a cell that is under the tool
    bool is_ball_;
    std::vector<float> above_;  // by the square of the distance from the axis: the tool's highest point over the cell
};

// What milling along a direction has removed: all above the heights of a map, infinite where it has removed nothing.
struct RemovedFoam {
    std::size_t orientation = 0;
    HeightField down_to;
};

class InProcessStock {
 public:
    // The whole block. The setup must outlive it.
    explicit InProcessStock(const Setup& setup, StockCells kind = StockCells::whole);

    // The highest foam along a direction over each whole cell, or over its middle, of `frame`, whose heights are not
    // looked at; `nothing` where there is none. The frame is a map of that direction (piece_height_field()); all frames
    // have cells of one size. O(cells * depth / cell * directions) at most; a ray ends at the first foam, and the next
    // time begins there unless its own direction has removed foam in its cell since.
    HeightField highest(std::size_t orientation, const HeightField& frame);

    // The same for the lowest foam: all of it lies above. Under it there may be air, where other directions or the
    // sides of the block end it. Rays begin anew.
    HeightField lowest(std::size_t orientation, const HeightField& frame);

    // All above the heights of a map of a direction is gone: infinite where nothing was removed. The maps of one
    // direction must have the same cells.
    void remove_above(std::size_t orientation, const HeightField& map);

    // What remove_above() was told, on cells `factor` times as wide, of which each has lost what all of its cells have.
    // Precondition: factor >= 1.
    std::vector<RemovedFoam> removed(double factor) const;

    // Whether a point in setup coordinates may be foam. O(directions).
    bool may_be_stock(Vec3 point) const;

 private:
    struct Removed {
        std::size_t orientation = 0;
        HeightField down_to;
        // How rays of other directions see it, made when they ask for it: raised, so that a sample speaks for all that
        // is less than a cell away, if cells are whole; and the highest of squares of some sizes.
        HeightField raised;
        std::vector<HeightField> tops;
    };
    // How far down the rays of a direction have found no foam, and what had been removed then.
    struct Seen {
        std::vector<std::uint16_t> steps;  // per cell
        std::size_t removals = 0;          // by other directions
    };
    class Rays;
    Rays rays_along(std::size_t orientation, const HeightField& frame, double step);
    const Removed* removed_along(std::size_t orientation) const;
    Seen& seen_along(std::size_t orientation, std::size_t cells);

    const Setup* setup_;
    StockCells kind_;
    std::vector<Removed> removed_;
    std::vector<Seen> seen_;             // by direction
    std::vector<std::size_t> removals_;  // of each direction
};

}  // namespace qchopper
