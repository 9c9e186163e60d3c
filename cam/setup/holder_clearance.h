// How deep the tip of a tool may go until holder or spindle touch the piece or come below the top of the spoil layer.
//
// mm. The piece alone is in the way: foam that other directions remove is taken as removed. Below its surface in the
// map it is taken as solid, so that under an overhang the limit is on the safe side.

#pragma once

#include <span>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cutting_tool.h"
#include "cam/cell/robot.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// The tool that goes deepest, with what is behind it. The tool itself, up to its stick-out, has the radius zero here.
struct ToolBody {
    double stick_out = 0;
    std::vector<HolderStep> steps;  // of the holder and then of the spindle's body, upwards from stick_out
};

// Of the tools of a cell, without its drills, the one with the largest stick-out, the first of equal ones.
// Precondition: there is one tool that is no drill.
const CuttingTool& longest_tool(std::span<const CuttingTool> tools);
// What lies between the spindle nose and the front of the spindle's body is taken to be as wide as the holder there.
ToolBody tool_body(const CuttingTool& tool, const Spindle& spindle);

// Raises a map to the least height at which the tip may stand, so that reached_share() finds what the tool reaches with
// its holder; whether it had to be raised anywhere. The piece is met on cells at least twice as wide and at most that
// share of the narrowest radius, unless that is less: the radius is right to within one of them. Preconditions: the
// direction of the map is not more than 90 degrees from the z axis of the setup. O(cells * radius / wider cell).
bool raise_to_holder_clearance(HeightField& map, const ToolBody& tool, const Pose& piece_in_setup,
                               double cells_per_radius = 12);

}  // namespace qchopper
