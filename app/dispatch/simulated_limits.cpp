// One pass over the blocks, and one over the tools.

#include "app/dispatch/simulated_limits.h"

#include <algorithm>

#include "cam/cell/job_tools.h"
#include "cam/setup/block.h"

namespace qchopper {
namespace {

// The largest extents of a block as it may stand: turned by 90 degrees about z, and sawn in any orientation.
Vec3 largest_stock(const Cell& cell) {
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

}  // namespace

CellLimits simulated_limits(const Cell& cell) {
    CellLimits limits;
    limits.cell_id = cell.id;
    limits.require_signature = cell.require_signature;
    const Vec3 base{cell.table.centre_x, cell.table.centre_y, cell.table.height + margins_of(cell).spoil};
    limits.workspace = {cell.workspace.min - base, cell.workspace.max - base};
    limits.max_stock = largest_stock(cell);
    for (const Tool& tool : tools_of(cell)) {
        limits.tools.push_back({tool.number, tool.diameter, tool.spindle_max_rpm, tool.feed_max_mm_per_min});
    }
    return limits;
}

}  // namespace qchopper
