// Limits of a simulated cell from a cell file of either version: id, reach, stock and all tools. Lengths in mm.
//
// A ticket that this program writes for a piece that fits the cell is within them
// (tests/app/cli/simulated_limits_test.cpp).

#pragma once

#include <algorithm>

#include "cam/cell/job_tools.h"
#include "cam/setup/block.h"
#include "sim/machine.h"

namespace qchopper {

// The largest extents of a block as it may stand: turned by 90 degrees about z, and sawn in any orientation. O(blocks).
inline Vec3 largest_stock(const Cell& cell) {
    Vec3 largest;
    for (const Stock& stock : cell.stock) {
        const double wide = std::max(stock.size.x, stock.size.y);
        const double longest = std::max(wide, stock.size.z);
        largest.x = std::max(largest.x, stock.is_sawn ? longest : wide);
        largest.y = largest.x;
        largest.z = std::max(largest.z, stock.is_sawn ? longest : stock.size.z);
    }
    return largest;
}

// The reach is in the base frame of a program whose block stands over the middle of the table: check_envelope() asks
// for that, and a ticket does not tell where else the block stands. O(blocks + tools).
inline CellLimits simulated_limits(const Cell& cell) {
    CellLimits limits;
    limits.cell_id = cell.id;
    const Vec3 base{cell.table.centre_x, cell.table.centre_y, cell.table.height + margins_of(cell).spoil};
    limits.reach = {cell.reach.min - base, cell.reach.max - base};
    limits.max_stock = largest_stock(cell);
    for (const Tool& tool : tools_of(cell)) {
        limits.tools.push_back({tool.number, tool.diameter, tool.spindle_max_rpm, tool.feed_max_mm_per_min});
    }
    return limits;
}

}  // namespace qchopper
