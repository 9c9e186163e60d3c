// Few points for a line that may deviate to one side only.
//
// mm, in a plane. The exact line is given by points; on its left a path may run, at most a tolerance away.

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

// A point of the exact line, and how far to its left the path may pass it.
struct Gate {
    Point2 right;
    Point2 left;
};

struct ReducedPoint {
    Point2 at;
    bool is_rounded = false;
};

struct ReductionOptions {
    double rounding = 0;      // from where on a controller may round a corner; 0: no corner is rounded
    std::size_t reach = 200;  // gates that one straight line may pass at most
};

// A path from the first gate to the last that passes all of them in their order: of those whose corners lie on gates at
// five places from their right to their left end one with the fewest corners, and of these one near the right ends. A
// corner may be rounded where the parabola that begins min(rounding, half the shorter side) before it is nowhere right
// of the exact line, to a fiftieth of the gates' width, and at most one and a half widths left of it; where that helps,
// a corner to be rounded lies 0.3 widths beyond its gate. Of a closed line the last gate is the first again, and so is
// the last point of the path. Precondition: at least two gates, no width is 0. O(gates * gates passed by a straight
// line).
std::vector<ReducedPoint> reduced_path(const std::vector<Gate>& gates, bool is_closed, const ReductionOptions& options);

}  // namespace qchopper
