// Roughing along one direction: level by level, from the top of the foam down to the allowance above the piece.
//
// mm, in the frame of the maps of that direction.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/cell/cutting_tool.h"
#include "cam/setup/holder_clearance.h"
#include "cam/toolpath/toolpath.h"
#include "cam/toolpath/toolpath_linker.h"
#include "segment/raster/height_field.h"

namespace qchopper {

struct RoughingOptions {
    // Foam that another direction or a larger tool left on its surface is left to finishing: what is not higher than
    // `skin_height`, or lies at most `skin_width` inside the rim of the tool, unless it stands higher than the flute
    // less two levels. Both 0 in the first direction.
    double skin_height = 0;
    double skin_width = 0;
    // Foam that may be cut at once: of so many levels the lowest is milled first, and what it leaves over the piece at
    // the others afterwards. 0: level by level.
    double deepest = 0;
};

struct RoughingRuns {
    std::vector<PathRun> runs;
    double removed_mm3 = 0;
    double deepest = 0;  // foam above the lowest tip, but for skins, before anything is removed
};

// Runs in map coordinates that leave no foam higher than a level's height above the tip limit where the tool comes to
// it, and none over flats of the limit that are four times as large as the tool; none where there is nothing to do. The
// space is that of the direction: its tip limit has the cells of the foam and includes the allowance, foam and removed
// are lowered. The step, stepdown and the feeds are the operation's. No cut removes foam above the flute, and holder
// and spindle stay clear of foam at every level: what they keep from is left. Checks for cancellation at each level.
// O(levels * cells * widest radius / cell).
RoughingRuns rough(MillingSpace& space, const CuttingTool& tool, const ToolBody& body, const Operation& operation,
                   const RoughingOptions& options, const Context& context);

}  // namespace qchopper
