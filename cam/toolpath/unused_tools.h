// Which tools a toolpath does not use along which direction, and why: what the job says of it.
//
// O(tools x directions x operations) (tests/cam/toolpath/make_toolpath_test.cpp).

#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/toolpath/toolpath.h"
#include "cam/toolpath/toolpath_settings.h"

namespace qchopper {

// Indices in CellMachine::tools and SurfaceAccess::orientations.
using ToolsAlong = std::set<std::pair<std::size_t, std::size_t>>;

// Of the ball-ended tools of the cell, of which the toolpath was made with those of `chosen`. `has_nothing` are those
// of them that have nothing to finish along a direction. A direction along which nothing is milled is listed once.
std::vector<UnusedTool> unused_tools(const CellMachine& machine, const ToolChoice& chosen, std::size_t directions,
                                     const Toolpath& toolpath, const ToolsAlong& has_nothing);

}  // namespace qchopper
