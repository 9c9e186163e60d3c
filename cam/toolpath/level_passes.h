// Finishing along levels of a tip surface, where it is steep.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/stock/tip_surface.h"
#include "cam/stock/tip_view.h"
#include "cam/toolpath/finishing_region.h"
#include "cam/toolpath/pass.h"
#include "cam/toolpath/raster_passes.h"

namespace qchopper {

// Cells over which all levels below a height are laid, whatever the tool touches.
struct LevelFloor {
    CellMask cells;  // empty: there are none
    double top = 0;
};

// What levels are for, and the tool over the target, if edges of the tip surface are to be found with it. They must
// outlive it.
struct LevelGround {
    const FinishingRegion& region;
    const LevelFloor& floor;
    const TipDilation* tool = nullptr;
};

// Levels over the cells that are allowed, where the tool touches the region, and at the floor. Their distance keeps the
// scallop height wherever the surface is steeper than `least_slope` (rise over run); between two levels further ones
// are laid where it curves inwards or is flatter over wanted cells. The lowest level is that of the lowest cell.
// Preconditions as of raster_passes; the region has the size of the map too.
std::vector<Pass> level_passes(const HeightMap& tip, const PassCells& cells, const LevelGround& ground,
                               double least_slope, const RasterOptions& options, const Context& context = {});

}  // namespace qchopper
