// Finishing along parallel rows of a CL surface, where it is flat to moderately steep.

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "cam/stock/cl_surface_view.h"
#include "cam/toolpath/finishing/path_reduction.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

struct RasterOptions {
    double radius = 0;   // mm, of the ball
    double scallop = 0;  // mm, above zero
    double path_tolerance = 0;
    double overlap = 0;   // mm: how far rows run beyond the cells
    double rounding = 0;  // as in ReductionOptions
};

// Rows over the cells that are allowed. Between two rows further ones are laid where the scallop would be higher over
// wanted cells, and the overlap beside them. They run along whichever axis of the map gives the less length. Points lie
// over the centres of columns of cells. Preconditions: the masks have the size of the map, 0 < scallop <= radius,
// path_tolerance > 0.
std::vector<Pass> raster_passes(const HeightField& cl, const PassCells& cells, const RasterOptions& options,
                                const Context& context = {});

}  // namespace qchopper
