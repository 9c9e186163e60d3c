// Divides runs of a toolpath: the tool retracts, and comes back to where it was.
//
// mm, in setup coordinates. Retract and approach go along the tool axis, through what the tool and its shank have
// just cleared. Pure functions.

#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// The first `count` moves with a retract behind them; before the others a link to 5 mm above the same point and an
// approach to it. All moves of
// the run are in one of the two, in their order. Precondition: 0 < count < run.moves.size().
std::pair<PathRun, PathRun> split_run(const PathRun& run, std::size_t count, Vec3 tool_axis, double retract);

// Lines that a run needs at most: its moves, and one more where the speed changes and where the rounding does.
std::size_t lines_of(const PathRun& run);

// Runs that need more than `lines` divided, at links where there are some near the end of a part. Precondition: lines
// is at least 12.
std::vector<PathRun> split_long_runs(const std::vector<PathRun>& runs, std::size_t lines, Vec3 tool_axis,
                                     double retract);

}  // namespace qchopper
