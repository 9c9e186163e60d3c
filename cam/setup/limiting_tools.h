// The two tools of a cell that limit what it reaches: the one that goes deepest and the finest. Drills are left out.
//
// mm. Precondition: a machine has a tool that is no drill.

#pragma once

#include <optional>

#include "cam/cell/cell.h"
#include "cam/setup/holder_clearance.h"

namespace qchopper {

struct LimitingTools {
    std::optional<ToolBody> longest;  // nothing in a cell without a machine: a tool without holder
    double smallest_radius = 0;       // 0: not known
};

LimitingTools limiting_tools(const Cell& cell);

}  // namespace qchopper
