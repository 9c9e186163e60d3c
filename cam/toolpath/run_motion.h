// How the moves of a run are driven: how far corners are rounded, and at which feed foam is cut.
//
// mm, mm/s. A controller follows the parabola with the tangents P - a d1 and P + a d2 about a corner P, whose largest
// distance from P is a cos(b / 2) / 2, b being the angle between the moves (a quadratic Bezier curve in its middle).
// tests/cam/toolpath/run_motion_test.cpp.

#pragma once

#include <span>

#include "base/vec3.h"
#include "cam/cell/cutting_tool.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// Of a tool's rate: the plan knows foam in cells of half a millimetre and more, and skins on walls are hardly thicker.
// The proof found up to 1.4 times what was planned.
constexpr double used_rate = 0.75;

// The largest distance of rounding, at most `largest`, with which the corner between from -> at -> to is passed within
// `deviation`. 0 where a move has no length.
double corner_rounding(Vec3 from, Vec3 at, Vec3 to, double deviation, double largest);

// A point of the parabola, 0 <= t <= 1, of a corner that is rounded from `rounding` before it on.
Vec3 on_parabola(Vec3 from, Vec3 at, Vec3 to, double rounding, double t);

// Sets PathMove::feed so that cuts and approaches remove foam no faster than used_rate of the tool's rate, less as much
// as a cell of the map of the foam is of the tool's diameter, on any moves that are together as long as the tool is
// wide, but no slower than its window allows. `removed_mm3`: of each move. That holds too where a move removes what is
// in the rounded corner at its end, as the proof has it, and the next one only the rest: roundings are set before.
// Feeds are those of the kind times a power of a ratio and change seldom, since each change is a line of the program.
// Of moves that remove too much together the fastest are slowed, to one feed. O(moves * moves within a diameter).
void limit_feeds(PathRun& run, std::span<const double> removed_mm3, double cell, const CuttingTool& tool,
                 const Operation& operation);

// Of all moves, without what acceleration takes. O(moves).
double seconds_at_feed(const PathRun& run, const Operation& operation);

// Lowers distances of rounding to a few values, and keeps one that holds as long as it is at least half of what the
// corner allows: each change is a line of the program. Where more than half a move is allowed, any value will do.
// O(moves).
void settle_rounding(PathRun& run, double largest);

}  // namespace qchopper
