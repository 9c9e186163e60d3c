// The picture of `cells show`: what the tool tip reaches at four tilts.

#pragma once

#include <vector>

#include "base/files/file.h"
#include "cam/cell/reach_map.h"
#include "segment/picture/png.h"

namespace qchopper {

// 0, 30, 60 and 90 degrees, in radians.
std::vector<double> pictured_tilts();

// One panel per tilt of pictured_tilts(), two by two, 1600 pixels wide: the squares of the section coloured by the
// share of directions of the tool axis in which the tip is held, the table, the reach box and the middle of the robot's
// base, axes in m, a legend and a scale bar. The map is that of the cell at pictured_tilts(); without a machine the
// panels hold table and reach box only, and the title says so.
Pixels draw_reach(const Cell& cell, const ReachMap& map);

}  // namespace qchopper
