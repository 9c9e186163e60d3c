// Finishing along levels of a CL surface, where it is steep.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/stock/cl_surface.h"
#include "cam/stock/cl_surface_view.h"
#include "cam/toolpath/finishing/finishing_region.h"
#include "cam/toolpath/finishing/raster_passes.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

// Cells over which all levels below a height are laid, whatever the tool touches.
struct WaterlineFloor {
    CellMask cells;  // empty: there are none
    double top = 0;
};

// What levels are for, and the tool over the target, if edges of the CL surface are to be found with it. They must
// outlive it.
struct WaterlineGround {
    const FinishingRegion& region;
    const WaterlineFloor& floor;
    const ToolDilation* tool = nullptr;
};

// Levels over the cells that are allowed, where the tool touches the region, and at the floor. Their distance keeps the
// scallop height wherever the surface is steeper than `min_slope` (rise over run); between two levels further ones
// are laid where it curves inwards or is flatter over wanted cells. The lowest level is that of the lowest cell.
// Preconditions as of raster_passes; the region has the size of the map too.
std::vector<Pass> waterline_passes(const HeightField& tip, const PassCells& cells, const WaterlineGround& ground,
                                   double min_slope, const RasterOptions& options, const Context& context = {});

}  // namespace qchopper
