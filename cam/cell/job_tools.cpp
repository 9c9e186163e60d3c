// Copies numbers.

#include "cam/cell/job_tools.h"

#include <cmath>

namespace qchopper {

Tool job_tool(const CuttingTool& tool) {
    return {tool.number,
            tool.name,
            tool.diameter,
            tool.rpm_max,
            static_cast<std::uint32_t>(std::floor(60 * tool.feed_max_mm_per_s)),
            tool.removal_mm3_per_s};
}

std::vector<Tool> tools_of(const Cell& cell) {
    if (!cell.machine) return {cell.tool};
    std::vector<Tool> tools;
    for (const CuttingTool& tool : cell.machine->tools) tools.push_back(job_tool(tool));
    return tools;
}

}  // namespace qchopper
