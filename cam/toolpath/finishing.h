// Finishing passes of one tool from one direction.
//
// mm. Wherever the tool fits, what stays between the passes is no higher than the scallop height, measured square to
// the surface; where they are rounded or their points reduced, by the path tolerance more
// (tests/cam/toolpath/finishing_test.cpp). No pass is below the tip surface, but for what tip_surface.h says of paths
// between middles of cells. The result does not depend on the number of threads.

#pragma once

#include <vector>

#include "base/context.h"
#include "cam/cell/carving_tool.h"
#include "cam/toolpath/finishing_region.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

struct FinishingOptions {
    double scallop = 0.25;
    double path_tolerance = 0.1;
    double rounding = 0;  // distance from a corner at which the controller begins to round it; 0: it does not
    // Steeper ground (degrees) is carved along levels, the rest along rows.
    double steep_deg = 50;
};

// The largest distance between neighbouring passes. Throws InputError (use) as finishing_passes does.
double finishing_step(const CarvingTool& tool, const FinishingOptions& options);

// `tip` is the tip surface of the tool, raised where holder and spindle ask for it; `region` says which of the surface
// is to be finished; passes go half a step beyond it. First the levels from above, then the rows. Throws InputError
// (use) if the scallop height, the path tolerance or the slope is not above zero, a value is not finite, the scallop
// height is above the radius of the tool, or the tool is no ball. O(cells + length of the passes / cell * gates that a
// straight line passes).
std::vector<Pass> finishing_passes(const HeightMap& tip, const CarvingTool& tool, const FinishingRegion& region,
                                   const FinishingOptions& options, const Context& context = {});

}  // namespace qchopper
