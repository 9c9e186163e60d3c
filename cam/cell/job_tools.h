// The tools of a cell: which rough and finish, as tickets name them, and a cell of which only some may be used.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

// As a ticket names the tool: its largest speed of the spindle, and its largest feed, rounded down to mm/min.
Tool job_tool(const CuttingTool& tool);

// All tools that a ticket may name: those of the machine, drills too, or the one of a cell without. O(tools).
std::vector<Tool> tools_of(const Cell& cell);

// The cell without its other tools: everything that plans with the tools of a cell then knows no others
// (tests/cam/cell/allowed_tools_test.cpp); `numbers` empty: as it is. Throws InputError (use) if the cell has no
// machine, has no tool of a number, or if none of the tools is ball-ended, because others do not finish. O(tools).
Cell with_tools(const Cell& cell, const std::vector<std::uint16_t>& numbers);

// Sets of tool numbers, each with one stick-out of every kind of tool (shape and diameter): the shortest of each kind
// first, then the next longer ones, last the longest. Of a kind with fewer stick-outs than others its longest stays.
// One empty set, which stands for all tools, where no kind has two. O(tools^2).
std::vector<std::vector<std::uint16_t>> tool_sets(const std::vector<CuttingTool>& tools);

// Indices of the tools that a program uses where it is not told others; of equal ones the first. O(tools).
// The flat or ball-ended one of the largest diameter, rather flat. Throws InputError (config) if there is none.
std::size_t roughing_tool(const std::vector<CuttingTool>& tools);
// The largest ball-ended one below a diameter, or else the largest. Throws InputError (config) if there is none.
std::size_t finishing_tool(const std::vector<CuttingTool>& tools, double roughing_diameter);
// The ball-ended ones of diameters within bounds, the largest first, of equal ones the shortest; of those that are
// equal in both the first alone.
std::vector<std::size_t> finishing_tools(const std::vector<CuttingTool>& tools, double least, double largest);

// "tool 3", "tools 1, 2 and 4". Precondition: there is one.
std::string describe_tools(const std::vector<std::uint16_t>& numbers);

}  // namespace qchopper
