// Limits of a simulated cell from a cell file: id, reach, stock and tool. Lengths in mm.

#pragma once

#include "cam/cell/cell.h"
#include "sim/machine.h"

namespace qchopper {

// The reach is in the base frame of the programs, whose origin is the middle of the table's top. O(blocks).
inline CellLimits simulated_limits(const Cell& cell) {
    CellLimits limits;
    limits.cell_id = cell.id;
    const Vec3 base{cell.table.centre_x, cell.table.centre_y, cell.table.height};
    limits.reach = {cell.reach.min - base, cell.reach.max - base};
    limits.max_stock = {};
    for (const Stock& stock : cell.stock) {
        const double wide =
            stock.size.x > stock.size.y ? stock.size.x : stock.size.y;  // it may be turned by 90 degrees about z
        for (int axis = 0; axis < 3; ++axis) {
            const double size = axis == 2 ? stock.size.z : wide;
            if (size > limits.max_stock[axis]) limits.max_stock[axis] = size;
        }
    }
    limits.tools = {{cell.tool.number, cell.tool.diameter, cell.tool.spindle_max_rpm, cell.tool.feed_max_mm_per_min}};
    return limits;
}

}  // namespace qchopper
