// One pass over the tools per choice. O(tools).

#include "cam/toolpath/toolpath_settings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "cam/cell/job_tools.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& to_do = "give another value") {
    throw InputError(InputFault::use, what, to_do);
}

std::size_t given(const CellMachine& machine, std::size_t tool, const std::string& name, bool must_be_ball) {
    if (tool >= machine.tools.size()) refuse(name + ": the cell has no tool at place " + std::to_string(tool + 1));
    if (must_be_ball && machine.tools[tool].shape != ToolShape::ball) {
        refuse(name + ": tool " + std::to_string(machine.tools[tool].number) + " is not ball-ended");
    }
    if (is_drill(machine.tools[tool])) {
        refuse(name + ": tool " + std::to_string(machine.tools[tool].number) + " is a drill");
    }
    return tool;
}

void check_scallop(double scallop, const CuttingTool& tool, const std::string& name) {
    if (!(scallop < 0.5 * tool.diameter))
        refuse(name + " is not less than the radius of tool " + std::to_string(tool.number));
}

void check_stepdown(const CuttingTool& tool, const ToolpathSettings& settings) {
    if (settings.stepdown <= tool.flute_length) return;
    refuse("step_down is deeper than the flute of tool " + std::to_string(tool.number) + " is long",
           "give at most " + std::to_string(std::lround(std::floor(tool.flute_length))) + " mm");
}

}  // namespace

ToolChoice choose_tools(const CellMachine& machine, const ToolpathSettings& settings) {
    const std::vector<CuttingTool>& tools = machine.tools;
    ToolChoice choice;
    choice.roughing =
        settings.roughing_tool ? given(machine, *settings.roughing_tool, "roughing_tool", false) : roughing_tool(tools);
    for (const std::size_t tool : settings.finishing_tools) {
        choice.finishing.push_back(given(machine, tool, "finishing_tools", true));
    }
    const auto is_smaller = [&](std::size_t a, std::size_t b) { return tools[a].diameter < tools[b].diameter; };
    if (std::adjacent_find(choice.finishing.begin(), choice.finishing.end(), is_smaller) != choice.finishing.end()) {
        refuse("finishing_tools: one is larger than the one before it");
    }
    if (!choice.finishing.empty()) return choice;
    const double main = tools[finishing_tool(tools, tools[choice.roughing].diameter)].diameter;
    const double least = std::max(settings.finest_tool, settings.fine == FineTools::none ? main : 0);
    choice.finishing = finishing_tools(tools, least, std::max(main, tools[choice.roughing].diameter));
    if (choice.finishing.empty()) {
        refuse("finest_tool: no ball-ended tool of the cell has a diameter of " + significant(least, 3) +
               " mm or more");
    }
    return choice;
}

double stepover_of(const CuttingTool& tool, const ToolpathSettings& settings) {
    constexpr double with_ridges = 0.6;  // between such passes a ball leaves ridges of a tenth of its diameter
    const double share = settings.stepover_share;
    return tool.diameter * (tool.shape == ToolShape::flat ? share : std::min(share, with_ridges));
}

double stepdown_of(const CuttingTool& tool, const ToolpathSettings& settings) {
    return std::min({settings.stepdown, 0.75 * tool.diameter, tool.flute_length});
}

void check_settings(const ToolpathSettings& settings, const CellMachine& machine, const ToolChoice& tools) {
    const std::vector<std::pair<const char*, double>> positive{{"scallop", settings.scallop},
                                                               {"cell", settings.cell},
                                                               {"path_tolerance", settings.path_tolerance},
                                                               {"step_down", settings.stepdown},
                                                               {"step_share", settings.stepover_share}};
    for (const auto& [name, value] : positive) {
        if (!(value > 0) || !std::isfinite(value)) refuse(std::string(name) + " of the toolpath is not above zero");
    }
    const std::vector<std::pair<const char*, double>> not_negative{{"allowance", settings.allowance},
                                                                   {"fine_allowance", settings.fine_allowance},
                                                                   {"beside_block", settings.beside_block.value_or(0)},
                                                                   {"rounding", settings.rounding}};
    for (const auto& [name, value] : not_negative) {
        if (!(value >= 0) || !std::isfinite(value)) refuse(std::string(name) + " of the toolpath is below zero");
    }
    if (settings.stepover_share >= 1) refuse("step_share of the toolpath is not less than 1");
    if (settings.fine_allowance > settings.allowance) refuse("fine_allowance is more than allowance");
    check_stepdown(machine.tools[tools.roughing], settings);
    check_stepdown(machine.tools[tools.finishing.front()], settings);
    for (const std::size_t tool : tools.finishing) check_scallop(settings.scallop, machine.tools[tool], "scallop");
}

Operation operation_of(const CellMachine& machine, std::size_t tool, OperationKind kind, std::size_t orientation) {
    const CuttingTool& used = machine.tools[tool];
    Operation operation;
    operation.kind = kind;
    operation.tool = tool;
    operation.orientation = orientation;
    operation.feed = used.feed_max_mm_per_s;
    operation.approach_feed = std::max(used.feed_min_mm_per_s, 0.5 * used.feed_max_mm_per_s);
    operation.link_feed = std::max(machine.program.link_feed_mm_per_s, operation.feed);
    operation.rpm = used.rpm_max;
    return operation;
}

}  // namespace qchopper
