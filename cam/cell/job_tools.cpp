// Copies numbers in one pass over the tools, O(tools), or one for each tool, O(tools^2).

#include "cam/cell/job_tools.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"

namespace qchopper {
namespace {

std::vector<std::uint16_t> numbers_of(const std::vector<CuttingTool>& tools) {
    std::vector<std::uint16_t> numbers;
    numbers.reserve(tools.size());
    for (const CuttingTool& tool : tools) numbers.push_back(tool.number);
    return numbers;
}

using IsBetter = std::function<bool(const CuttingTool&, const CuttingTool&)>;
using IsMeant = std::function<bool(const CuttingTool&)>;

// The best of the tools that are meant, the first of equal ones.
std::optional<std::size_t> best(const std::vector<CuttingTool>& tools, const IsMeant& is_meant,
                                const IsBetter& is_better) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < tools.size(); ++i) {
        if (is_meant(tools[i]) && (!found || is_better(tools[i], tools[*found]))) found = i;
    }
    return found;
}

bool is_ball(const CuttingTool& tool) {
    return tool.shape == ToolShape::ball;
}

bool is_larger(const CuttingTool& a, const CuttingTool& b) {
    return a.diameter > b.diameter;
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
        throw InputError(InputFault::use, "the cell file describes no machine, and has one tool",
                         Sentence::with_key("leave_tools", {}, "leave out which tools may be used"));
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

std::vector<std::vector<std::uint16_t>> tool_sets(const std::vector<CuttingTool>& tools) {
    // Of each tool, how many stick-outs of its kind are shorter, and how many there are.
    std::vector<std::size_t> shorter(tools.size());
    std::vector<std::size_t> of_kind(tools.size());
    for (std::size_t i = 0; i < tools.size(); ++i) {
        std::set<double> lengths;
        for (const CuttingTool& tool : tools) {
            if (tool.shape == tools[i].shape && tool.diameter == tools[i].diameter) lengths.insert(tool.stick_out);
        }
        of_kind[i] = lengths.size();
        shorter[i] = static_cast<std::size_t>(std::distance(lengths.begin(), lengths.find(tools[i].stick_out)));
    }
    const std::size_t most = tools.empty() ? 1 : *std::ranges::max_element(of_kind);
    if (most == 1) return {{}};
    std::vector<std::vector<std::uint16_t>> sets(most);
    for (std::size_t s = 0; s < most; ++s) {
        for (std::size_t i = 0; i < tools.size(); ++i) {
            if (shorter[i] == std::min(s, of_kind[i] - 1)) sets[s].push_back(tools[i].number);
        }
    }
    return sets;
}

std::size_t roughing_tool(const std::vector<CuttingTool>& tools) {
    const auto found = best(
        tools, [](const CuttingTool& t) { return is_ball(t) || t.shape == ToolShape::flat; },
        [](const CuttingTool& a, const CuttingTool& b) {
            return std::pair(a.diameter, a.shape == ToolShape::flat) >
                   std::pair(b.diameter, b.shape == ToolShape::flat);
        });
    if (!found)
        throw InputError(InputFault::config, "the cell has no flat or ball-ended tool", "add one to the cell file");
    return *found;
}

std::size_t finishing_tool(const std::vector<CuttingTool>& tools, double roughing_diameter) {
    const IsMeant is_smaller = [&](const CuttingTool& t) { return is_ball(t) && t.diameter < roughing_diameter; };
    auto found = best(tools, is_smaller, is_larger);
    if (!found) found = best(tools, is_ball, is_larger);
    if (!found) throw InputError(InputFault::config, "the cell has no ball-ended tool", "add one to the cell file");
    return *found;
}

std::vector<std::size_t> finishing_tools(const std::vector<CuttingTool>& tools, double least, double largest) {
    std::vector<std::size_t> balls;
    for (std::size_t i = 0; i < tools.size(); ++i) {
        if (is_ball(tools[i]) && tools[i].diameter >= least && tools[i].diameter <= largest) balls.push_back(i);
    }
    const auto key = [&](std::size_t i) { return std::pair(-tools[i].diameter, tools[i].stick_out); };
    std::ranges::stable_sort(balls, {}, key);
    const auto is_equal = [&](std::size_t a, std::size_t b) { return key(a) == key(b); };
    balls.erase(std::unique(balls.begin(), balls.end(), is_equal), balls.end());
    return balls;
}

}  // namespace qchopper
