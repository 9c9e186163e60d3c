// The parts of a pass along which a ball cuts foam.
//
// mm, in the frame of the maps of a direction. Other passes, tools and directions leave stretches of air in a pass:
// where regions overlap, and where a larger ball has come nearly as deep. The tool goes straight to what is left.

#pragma once

#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/toolpath/pass.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// `stock` is the highest foam at the centres of cells, the piece included. A ball cuts where it takes more than a
// `film` off one of them, which samples half a cell apart tell, and along walls of 83 degrees or more, on which foam
// may lie between centres. O(length / cell * (radius / cell)^2) (tests/cam/toolpath/cutting_parts_test.cpp).
bool is_cutting(const Pass& pass, const HeightField& stock, const CuttingTool& tool, double film);

// The passes without air at their ends, but for 1 mm, and without air between two cuts that is longer than what a way
// around it costs. Those that do not cut are left out.
std::vector<Pass> cutting_parts(const std::vector<Pass>& passes, const HeightField& stock, const CuttingTool& tool,
                                double film);

}  // namespace qchopper
