// Limits of a simulated cell from a cell file: id, reach, stock, all tools, and whether it requires signatures. Lengths
// in mm.
//
// A ticket that this program writes for a piece that fits the cell is within them
// (tests/app/dispatch/simulated_limits_test.cpp).

#pragma once

#include "cam/cell/cell.h"
#include "sim/cell/machine.h"

namespace qchopper {

// The reach is in the base frame of a program whose block stands over the middle of the table: check_stock_fit() asks
// for that, and a ticket does not tell where else the block stands. O(blocks + tools).
CellLimits simulated_limits(const Cell& cell);

}  // namespace qchopper
