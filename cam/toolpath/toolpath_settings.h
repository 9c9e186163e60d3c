// What a toolpath is asked for, and with which tools of a cell it is made. Lengths in mm, speeds in mm/s.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// Which of the tools that finish go on where larger ones are done: all; those that add worthwhile_share of the surface
// and more; none that is smaller than the largest ball below the tool of the roughing.
enum class FineTools : std::uint8_t { all, worthwhile, none };

struct ToolpathSettings {
    double scallop = 0.25;  // height of the ridges that finishing leaves at most where the tool fits
    double path_tolerance = 0.1;
    double cell = 0.25;            // of the maps for finishing
    double allowance = 1.5;        // that roughing leaves
    double fine_allowance = 0.5;   // that roughing with the tool of the finishing leaves
    double stepdown = 15;          // largest height of a level of roughing
    double stepover_share = 0.85;  // largest distance between passes of roughing with a flat end, of its diameter
    double rounding = 5;           // see PathMove::rounding: the largest
    // How far roughing comes beside the projection of the block; nothing: as far as it takes to begin beside the foam.
    std::optional<double> beside_block;
    std::optional<std::size_t> roughing_tool;  // index in CellMachine::tools; nothing: chosen by choose_tools()
    std::vector<std::size_t> finishing_tools;  // in their order; empty: chosen by choose_tools() and worthwhile_tools()
    // Of tools by number: the share of their largest feed at which they cut, but no less than their least feed;
    // others 1.
    std::map<std::uint16_t, double> feed_shares;
    FineTools fine = FineTools::worthwhile;
    double finest_tool = 0;  // least diameter of those that finish
};

// Indices in CellMachine::tools.
struct ToolChoice {
    std::size_t roughing = 0;
    std::vector<std::size_t> finishing;  // ball-ended, at least one, none larger than those before it
};

// Roughing: the largest flat or ball-ended tool, of equal ones a flat one, then the first. Finishing: all balls that
// are no larger than that, or all balls if none is; first the largest, of equal ones the shortest, then the first; of
// equal ones that are equally long the first alone. Throws InputError: config if the cell has no ball-ended tool, use
// if a tool of the settings is not in the cell or finishing is asked of one that is not ball-ended.
ToolChoice choose_tools(const CellMachine& machine, const ToolpathSettings& settings);

// Distance between the rows of roughing with a tool: of others than flat ends at most 0.6 of the diameter.
double stepover_of(const CuttingTool& tool, const ToolpathSettings& settings);

// Height of the levels of roughing with a tool: at most that of the settings, three quarters of its diameter, and its
// flute.
double stepdown_of(const CuttingTool& tool, const ToolpathSettings& settings);

// Throws InputError (use), which names the setting, if one is not finite or not above zero (allowances and beside_block
// may be zero), if the height of levels is more than the flute of a tool that roughs, but for the fine one, if the
// distance between passes is not less than the diameter, or the scallop height not less than the radius of the tool of
// the finishing.
void check_settings(const ToolpathSettings& settings, const CellMachine& machine, const ToolChoice& tools);

// Feeds and speed of a tool, in an operation without runs. A cut has the largest feed of the tool's window, an approach
// half of that but at least the least one, links the cell's.
Operation operation_of(const CellMachine& machine, std::size_t tool, OperationKind kind, std::size_t orientation);

}  // namespace qchopper
