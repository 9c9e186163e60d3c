// O(tools).

#include "cam/setup/limiting_tools.h"

#include <algorithm>
#include <limits>

namespace qchopper {

LimitingTools limiting_tools(const Cell& cell) {
    if (!cell.machine) return {std::nullopt, cell.tool.diameter / 2};
    double smallest = std::numeric_limits<double>::infinity();
    for (const CuttingTool& tool : cell.machine->tools) {
        if (!is_drill(tool)) smallest = std::min(smallest, tool.diameter);
    }
    return {tool_body(longest_tool(cell.machine->tools), *cell.machine), smallest / 2};
}

}  // namespace qchopper
