// The stock that a part of a program left, on larger cells: to go on from there where less is asked of the cells.

#pragma once

#include "sim/replay/stock/stock_record.h"

namespace qchopper {

// Each cell has the largest of the heights of the four cells about its middle, so that the stock is not less. The tools
// stay. Precondition: cell >= stock.cell. O(cells) (tests/sim/replay/stages/coarser_stock_test.cpp).
StockRecord coarser(const StockRecord& stock, double cell);

}  // namespace qchopper
