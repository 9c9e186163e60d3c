// Finishing along levels of a tip surface, where it is steep.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/toolpath/pass.h"
#include "cam/toolpath/raster_passes.h"
#include "cam/toolpath/tip_view.h"

namespace qchopper {

// Levels over the cells of the mask, and beyond them by the overlap. Their distance keeps the scallop height wherever
// the surface is steeper than `least_slope` (rise over run); between two levels further ones are laid where it curves
// inwards or is flatter. The lowest level is that of the lowest cell. Preconditions as of raster_passes.
std::vector<Pass> level_passes(const HeightMap& tip, const CellMask& mask, double least_slope,
                               const RasterOptions& options, const Context& context = {});

}  // namespace qchopper
