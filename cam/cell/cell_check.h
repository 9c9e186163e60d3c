// What a cell file does not state for certain, and whether jobs for it may be handed to a real controller.

#pragma once

#include <string>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

struct CellCheck {
    std::vector<ValueOrigin> uncertain;  // assumed, unstated or by default, in the order of Cell::origins
    std::vector<std::string> missing;    // what the file does not describe, one sentence each
    // Why no job may be handed to a real controller, one sentence each: a frame, a length of the arm, a joint limit or
    // an axis' travel that is assumed or of unstated origin, or a tool of a machine whose length is not measured.
    // Planning and simulation are allowed all the same.
    std::vector<std::string> against_dispatch;
    bool may_be_dispatched() const { return against_dispatch.empty(); }
    bool operator==(const CellCheck&) const = default;
};

// O(values of the file).
CellCheck check_cell(const Cell& cell);

}  // namespace qchopper
