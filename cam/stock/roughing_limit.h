// How deep and how far beside the foam the tip of a roughing tool goes.
//
// mm. Maps of one direction that share their frame.

#pragma once

#include "cam/cell/cutting_tool.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// Raises a CL surface where the tip would be more than the height of a level below all foam that the tool may touch:
// where a tilted tool sticks out of the far side of the block there is nothing to cut, and the arm would have to come
// nearer to the block. `lowest`: InProcessStock::lowest(). O(cells * radius / cell).
void stay_near_stock(HeightField& tip, HeightField lowest, const CuttingTool& tool, double level);

// Closes cells that are farther than that beside foam, of which `foam` is the highest. Cost as above.
void close_beside_stock(HeightField& tip, const HeightField& stock, double beside);

}  // namespace qchopper
