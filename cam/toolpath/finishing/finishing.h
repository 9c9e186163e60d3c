// Finishing passes of one tool from one direction.
//
// mm. Wherever the tool fits, what stays between the passes is no higher than the scallop height, measured square to
// the surface, and in all no more than that, 1.3 path tolerances and two cells of the map
// (tests/cam/toolpath/finishing_test.cpp): the CL surface is higher than the exact one by up to the diagonal of a cell
// across a slope, and along a vertical edge levels keep 0.75 cells away from it besides, or a sixteenth of a cell where
// the tool over the target is known. No pass is below the CL surface, which lies between the centres of cells where
// the tool over the target says, but for what cl_surface.h says of paths between centres and for a fiftieth of the
// path tolerance where a corner is rounded. The result does not depend on the number of threads.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/cell/cutting_tool.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/finishing/finishing_region.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

struct FinishingOptions {
    double scallop = 0.25;
    double path_tolerance = 0.1;
    double rounding = 0;  // distance from a corner at which the controller begins to round it; 0: it does not
    // Steeper ground (degrees) is milled along levels, the rest along rows.
    double steep_deg = 50;
    // The floor around the piece, in the cells of the map: levels go round whatever stands on it, up to the radius
    // of the tool above it. Nothing: there is none.
    const FinishingRegion* floor = nullptr;
    // The tool over the target, as the CL surface was made with it: levels then go along vertical edges where these
    // are, and not a cell beside them. Nothing: it is not known.
    const ToolDilation* tool = nullptr;
    // The tiles in which the CL surface is known: at least those within finishing_margin() of the region and the floor.
    // Nothing: all.
    const FieldTiles* tiles = nullptr;
};

// The largest distance between neighbouring passes. Throws InputError (use) as finishing_passes does.
double finishing_stepover(const CuttingTool& tool, const FinishingOptions& options);

// How far beside a region and the floor passes depend on the CL surface. Throws as finishing_stepover.
double finishing_margin(const CuttingTool& tool, const FinishingOptions& options, double cell);

// `cl` is the CL surface of the tool, raised where holder and spindle ask for it; `region` says which of the surface
// is to be finished; passes go a tenth of a step beyond it, and such as are shorter than three quarters of a step are
// left out where a longer one is near. First the levels from above, then the rows. Throws InputError (use) if the
// scallop height, the path tolerance or the slope is not above zero, a value is not finite, the scallop height is above
// the radius of the tool, or the tool is no ball. O(cells + length of the passes / cell * gates that a straight line
// passes).
std::vector<Pass> finishing_passes(const HeightField& cl, const CuttingTool& tool, const FinishingRegion& region,
                                   const FinishingOptions& options, const Context& context = {});

}  // namespace qchopper
