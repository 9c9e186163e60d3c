// How deep the swept tool cuts into the target: from the tool's true shape to the target's triangles, without cells.
//
// mm. The gouge of a move at a point of the surface is how deep the point lies inside of the swept tool, its distance
// from the tool's surface: sideways at walls, upwards at floors. Of a triangle it is the largest over its points, found
// by bisection: a part of a triangle is left out when a lower bound of the distance (convex along the triangle for a
// ball, else by its slope of at most 1) shows that it is no deeper than what was found. Corners that may be rounded are
// tested both exact and as the parabola. The result does not depend on the number of threads
// (tests/sim/replay/gouge_test.cpp).

#pragma once

#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "sim/replay/scene.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

constexpr double gouge_resolution = 0.004;  // mm: a found depth is too small by at most that much

// The deepest point of a triangle in a swept cutter, in the cutter's frame; `floor` or less: not deeper than that.
double deepest_in(const SweptCutter& swept, const std::array<Vec3, 3>& triangle, double floor);

struct GougeFigures {
    std::vector<float> depth;  // per triangle, 0: at most `floor`
    double largest = 0;
    SourcePlace place;  // of the line that cut deepest
    Vec3 at;            // a point of that triangle: its middle
};

// Depths up to `floor` are not told apart from 0. Throws Cancelled.
GougeFigures find_gouges(const ToolPath& path, const ReplayScene& scene, double floor, const Context& context);

}  // namespace qchopper
