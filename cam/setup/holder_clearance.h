// How deep the tip of a tool may go until holder or spindle touch the piece or the foam, or come below the top of the
// spoil layer.
//
// mm. Below its surface in a map the piece is taken as solid, so that under an overhang the limit is on the safe side.
// Drills, along axes that are not those of maps, are asked point by point in cam/toolpath/drilling.cpp; the replay has
// its own by rule (sim/replay/reach/reachable.cpp). Held by tests/cam/stock/cl_surface_test.cpp and
// tests/cam/toolpath/passes_and_links_test.cpp.

#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cell.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// A tool with what is behind it. The tool itself, up to its stick-out, has the radius zero here.
struct ToolBody {
    double stick_out = 0;
    std::vector<HolderStep> steps;  // of the holder, the spindle's body and the wrist, upwards from stick_out
};

// Of the tools of a cell, without its drills, the one with the largest stick-out, the first of equal ones.
// Precondition: there is one tool that is no drill.
const CuttingTool& longest_tool(std::span<const CuttingTool> tools);
// Holder, spindle and wrist as bodies_over_tip() has them, each up to the front of the next. The wrist keeps the
// distance of the arm (PoseCheck::arm_to_block) to foam and piece.
ToolBody tool_body(const CuttingTool& tool, const CellMachine& machine);

// Of the tip in the setup, so that no step comes below z = 0: for the angle between tool axis and z.
double min_tip_z(const ToolBody& tool, double sine, double cosine);

// Raises a map of the piece to the least height at which the tip may stand, so that reached_share() finds what the tool
// reaches with its holder; whether it had to be raised anywhere. The piece is met on cells at least twice as wide and
// at most that share of the narrowest radius, unless that is less: the radius is right to within one of them.
// Preconditions: the direction of the map is not more than 90 degrees from the z axis of the setup. O(cells * radius /
// wider cell).
bool raise_to_holder_clearance(HeightField& map, const ToolBody& tool, const Pose& piece_in_setup,
                               double cells_per_radius = 12);

// Raises a CL surface to where holder and spindle stay clear of the target and above z = 0 of the setup as well; on
// the safe side by at most three cells of raise_to_holder_clearance(), which are at most a 48th of the holder's least
// radius wide, or two cells of the map. Whether it was raised anywhere. Precondition: both maps have the same cells.
bool raise_to_holder(HeightField& tip, const HeightField& target, const ToolBody& body, const Pose& piece_in_setup);

// How near to foam holder and spindle come, and how exactly that is known.
struct HolderGap {
    double clearance = 0.3;  // mm
    double wide_cells = 1;   // cells of the foam, each way, that are taken as one for wide steps of the holder
};

// The least height of the tip at which holder and spindle stay clear of foam, for each cell of its map. For tips that
// are never below `lowest`: limits below it may be lower than they are. O(cells * widest radius / cell) at most.
HeightField holder_clearance_over(const HeightField& stock, const ToolBody& body, const HolderGap& gap = {},
                                  double lowest = -std::numeric_limits<double>::infinity());

// Whether any of these limits over foam that is nowhere higher than `highest` can be as high as `lowest`.
bool is_holder_limiting(double highest, const ToolBody& body, const HolderGap& gap, double lowest);

}  // namespace qchopper
