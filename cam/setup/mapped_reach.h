// What the tool reaches from the directions of a setup, by one height map per direction.
//
// mm. A triangle counts by the share of it that a direction reaches, the largest over the directions. Agrees with rays
// from the surface within half a percent of the area, per direction (tests/cam/setup/mapped_reach_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/pose.h"
#include "cam/cell/carving_tool.h"
#include "cam/cell/robot.h"
#include "cam/setup/surface_reach.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The tool that goes deepest, with what is behind it. The tool itself, up to its stick-out, has the radius zero here.
struct ToolBody {
    double stick_out = 0;
    std::vector<HolderStep> steps;  // of the holder and then of the spindle's body, upwards from stick_out
};
// Of the tools of a cell the one with the largest stick-out.
ToolBody tool_body(const CarvingTool& tool, const Spindle& spindle);

struct MappedSetup {
    const TriangleMesh* mesh = nullptr;  // in piece coordinates, consistent
    std::optional<std::int32_t> base;    // cut whose cap lies on the table
    Vec3 up;                             // unit
    Pose piece_in_setup;                 // z = 0 is the top of the spoil layer
    Box block;                           // in setup coordinates, the spoil layer included
    std::vector<Vec3> directions;        // unit, in piece coordinates; the first is `up`
    std::optional<ToolBody> tool;        // nothing: a tool without holder
    double smallest_ball_radius = 0;     // of the tools, for the residue; 0: none is computed
    bool steep_counts = true;
};

struct MapOptions {
    double cell = 0;  // mm; 0: a thousandth of the longest side of the piece's box, 0.25 mm at least
};

struct MappedReach {
    SurfaceReach reach;                // method mapped; all_directions_share, further, too_narrow_mm2 are left at 0
    std::vector<SurfaceState> states;  // per triangle; the base's are `reached`
};

// Holder and spindle may not touch the piece (any other direction's foam is assumed to be removed first) nor come below
// z = 0. Preconditions: there is a direction, the mesh has area. O(directions x (triangles + cells)), 8 bytes a cell of
// the maps that are held together and 4 bytes per triangle and direction.
MappedReach mapped_reach(const MappedSetup& setup, const MapOptions& options = {});

}  // namespace qchopper
