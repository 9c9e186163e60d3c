// The plain loop that a replay is held against: one height field of square cells per orientation, lowered under every
// straight move of a program, cell by cell, without any proof.
//
// mm, setup coordinates. Of a ball and a flat end the height of the swept tool over a cell is exact; of bull, cone and
// drill it is that of the tool where its axis passes the cell nearest, which is exact on level moves and on plunges.

#pragma once

#include <cstddef>
#include <vector>

#include "base/box.h"
#include "cam/cell/cell.h"
#include "sim/replay/tool_path.h"

namespace qchopper::bench {

struct PlainLoop {
    double cpu_s = 0;         // of the loop alone, which counts nothing
    std::size_t moves = 0;    // straight ones
    double length = 0;        // of them
    std::size_t cells = 0;    // that the loop looks at, of all moves
    std::size_t lowered = 0;  // of them those that it lowers
    std::size_t cut = 0;      // cells of the fields that are lowered at least once
};

// `tool_axes` are unit vectors, by TipLine::orientation; fields end where the block does. CPU time is the least of
// `runs`. Precondition: cell > 0. O(cells under the moves).
PlainLoop plain_loop(const std::vector<TipLine>& lines, const Box& block, const std::vector<Vec3>& tool_axes,
                     const std::vector<CuttingTool>& tools, double cell, int runs);

}  // namespace qchopper::bench
