// Checks that the block fits into the cell and the piece into the block: one named margin per condition.
//
// Lengths in mm; a negative margin is a violated condition. Boxes only, no kinematics. A piece fits when no margin is
// negative beyond rounding, 1e-6 (tests/cam/setup/stock_fit_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "cam/setup/setup.h"

namespace qchopper {

struct Margin {
    std::string name;     // "block top to reach ceiling"
    std::string problem;  // what is wrong when it is negative: "too high for block ..."
    double mm = 0;
    bool operator==(const Margin&) const = default;
};

struct StockFit {
    std::vector<Margin> margins;
    bool operator==(const StockFit&) const = default;
    bool fits() const;
    // The smallest margin, of equal ones the first. Precondition: there is a margin.
    const Margin& worst() const;
};

// Always the same 11 conditions in the same order. Precondition: setup.block.stock is an index in cell.stock.
StockFit check_stock_fit(const Setup& setup, const Cell& cell);

// The largest block that stands in the cell: a block of no larger size along any axis is held by all conditions but
// those on its piece. A size that is not positive: no block stands there.
Vec3 largest_block(const Cell& cell);

// "piece B does not fit: 32 mm too high for block medium (600 x 400 x 400 mm), ..."; "piece B fits, ..." otherwise.
// Precondition: there is a margin.
std::string describe_stock_fit(const std::string& piece, const StockFit& report);

}  // namespace qchopper
