// The tools of a cell as tickets name them.

#pragma once

#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// As a ticket names the tool: its largest speed of the spindle, and its largest feed, rounded down to mm/min.
Tool job_tool(const CuttingTool& tool);

// All tools that a ticket may name: those of the machine, drills too, or the one of a cell without. O(tools).
std::vector<Tool> tools_of(const Cell& cell);

}  // namespace qchopper
