// The parts of a pass along which a tool cuts foam.
//
// mm, in the frame of the maps of a direction. Other passes, tools and directions leave stretches of air in a pass:
// where regions overlap, and where a larger ball has come nearly as deep. The tool goes straight to what is left.

#pragma once

#include <functional>
#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/toolpath/pass.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// `stock` is the highest foam at the centres of cells, the piece included. A ball cuts where it takes more than a
// `film` off one of them, which samples half a cell apart tell, and along walls of 83 degrees or more, on which foam
// may lie between centres. O(length / cell * (radius / cell)^2) (tests/cam/toolpath/cutting_parts_test.cpp).
bool is_cutting(const Pass& pass, const HeightField& stock, const CuttingTool& tool, double film);

// Of a pass: how far apart it is asked whether the tool cuts, and how much air stays beside a cut.
struct AirOptions {
    double apart = 0.25;
    double beside = 1;
};

// A pass without air at its ends, and without air between two cuts that is longer than what a way around it costs;
// nothing if it does not cut. `cuts` says whether a tool with its tip at a point cuts.
std::vector<Pass> cutting_parts(const Pass& pass, const AirOptions& options, const std::function<bool(Vec3)>& cuts);

// The same of the passes of a ball, which cuts as above; 1 mm of air stays.
std::vector<Pass> cutting_parts(const std::vector<Pass>& passes, const HeightField& stock, const CuttingTool& tool,
                                double film);

}  // namespace qchopper
