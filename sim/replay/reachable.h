// Where the tools of a program can come to on the target: the closing of the target by tool and holder, computed here.
//
// mm. Per direction the highest points of the target and of the floor of the spoil layer on square cells; the least
// heights at which the finest tool of that direction may stand, its holder and the spindle clear; and the lowest
// surface that it then leaves. O(cells * (radius / cell)^2) (tests/sim/replay/ball_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "sim/replay/scene.h"

namespace qchopper {

// A surface over the plane of one direction's frame.
struct SurfaceMap {
    Pose frame_in_setup;
    double x_min = 0;  // corner of the first cell
    double y_min = 0;
    double cell = 1;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::vector<float> height;  // at the middles of cells, row by row; -1e30: nothing
    double at(double x, double y) const;
    // Distance from a point of the frame to the nearest point above the surface, at most `most`; cells count at their
    // middles.
    double distance_above(Vec3 point, double most) const;
};

// The closing along a direction by a tool. Throws Cancelled.
SurfaceMap closing_of(const ReplayScene& scene, std::size_t direction, const CarvingTool& tool, double cell,
                      const Context& context);

// The tools that the program uses along each direction, and those that parts before it used: ascending, each once.
std::vector<StockTool> used_tools(const ReplayScene& scene);

// The finest tool that each direction of the program has a chunk for, parts before included: index in
// CellMachine::tools, of equal ones the first; nothing for a direction without a chunk. Drills do not count.
std::vector<std::optional<std::size_t>> finest_tools(const ReplayScene& scene);

}  // namespace qchopper
