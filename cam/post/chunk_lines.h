// What the chunks of every language have in common: the comments at their beginning, and which moves are written.

#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/post/dialect_post.h"
#include "cam/post/program_lines.h"
#include "cam/program/program.h"

namespace qchopper {

// Comments: which chunk it is, direction, tool, operation, size.
void describe_chunk(const Program& program, const CellMachine& machine, const RunRange& range, std::size_t order,
                    std::size_t total, ProgramLines& text);

// A move as it is written.
struct WrittenMove {
    Vec3 tip;
    std::string position;  // its text
    double speed = 0;
    double rounding = 0;  // 0: the corner at its end is exact
};

// Those of a run whose text says another place than the one before. The corner at such a place is rounded only if every
// move that ends there allows it, and never where a run ends. `position` writes a place. O(moves).
std::vector<WrittenMove> written_moves(const ProgramRun& run, const std::function<std::string(Vec3)>& position);

// The largest multiple of `unit` that is not above the value, but for rounding.
double rounded_down(double value, double unit);

}  // namespace qchopper
