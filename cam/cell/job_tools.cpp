// Copies numbers; one pass over the tools.

#include "cam/cell/job_tools.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace qchopper {
namespace {

std::vector<std::uint16_t> numbers_of(const std::vector<CuttingTool>& tools) {
    std::vector<std::uint16_t> numbers;
    numbers.reserve(tools.size());
    for (const CuttingTool& tool : tools) numbers.push_back(tool.number);
    return numbers;
}

}  // namespace

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

std::string describe_tools(const std::vector<std::uint16_t>& numbers) {
    std::string text = numbers.size() == 1 ? "tool " : "tools ";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) text += i + 1 == numbers.size() ? " and " : ", ";
        text += std::to_string(numbers[i]);
    }
    return text;
}

Cell with_tools(const Cell& cell, const std::vector<std::uint16_t>& numbers) {
    if (numbers.empty()) return cell;
    if (!cell.machine) {
        throw InputError(InputFault::use, "the cell file describes no machine, and has one tool", "leave --tools out");
    }
    const std::vector<std::uint16_t> listed = numbers_of(cell.machine->tools);
    for (const std::uint16_t number : numbers) {
        if (std::find(listed.begin(), listed.end(), number) != listed.end()) continue;
        throw InputError(InputFault::use, "the cell file lists no tool " + std::to_string(number),
                         "name some of its " + describe_tools(listed));
    }
    Cell allowed = cell;
    std::vector<CuttingTool>& tools = allowed.machine->tools;
    std::erase_if(tools, [&](const CuttingTool& tool) {
        return std::find(numbers.begin(), numbers.end(), tool.number) == numbers.end();
    });
    if (std::none_of(tools.begin(), tools.end(), [](const CuttingTool& t) { return t.shape == ToolShape::ball; })) {
        throw InputError(InputFault::use,
                         "of " + describe_tools(numbers) + " none is ball-ended, and others do not finish",
                         "name a ball-ended one too");
    }
    allowed.tool = job_tool(tools.front());
    return allowed;
}

}  // namespace qchopper
