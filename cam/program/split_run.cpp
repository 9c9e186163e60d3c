// One pass over the moves. O(moves).

#include "cam/program/split_run.h"

#include <cassert>
#include <cstdint>

namespace qchopper {
namespace {

constexpr double approach_height = 5;  // mm
constexpr double near_the_end = 0.9;   // of the lines of a part

bool is_same_speed(const PathMove& a, const PathMove& b) {
    const auto is_link = [](MoveKind kind) { return kind == MoveKind::link || kind == MoveKind::retract; };
    return (a.kind == b.kind && a.feed == b.feed) || (is_link(a.kind) && is_link(b.kind));
}

// Lines of a move but the first: speed and rounding are stated where they change.
std::size_t lines_of(const PathMove& move, const PathMove& before, double rounding) {
    return 1 + (is_same_speed(move, before) ? 0 : 1) + (move.rounding > 0 && move.rounding != rounding ? 1 : 0);
}

// How many moves go into the first part.
std::size_t first_part(const PathRun& run, std::size_t lines) {
    const std::size_t most = lines - 3;  // less the retract, and the speeds at both ends
    std::size_t used = 1;
    std::size_t at_link = 0;
    double rounding = 0;
    for (std::size_t i = 0; i < run.moves.size(); ++i) {
        used += lines_of(run.moves[i], run.moves[i > 0 ? i - 1 : 0], rounding);
        if (run.moves[i].rounding > 0) rounding = run.moves[i].rounding;
        if (used > most) return at_link > 0 ? at_link : i;
        const bool is_late = static_cast<double>(used) > near_the_end * static_cast<double>(most);
        if (is_late && i > 0 && run.moves[i].kind == MoveKind::link) at_link = i;
    }
    return run.moves.size();
}

}  // namespace

std::pair<PathRun, PathRun> split_run(const PathRun& run, std::size_t count, Vec3 tool_axis, double retract) {
    assert(count > 0 && count < run.moves.size());
    const auto middle = run.moves.begin() + static_cast<std::ptrdiff_t>(count);
    PathRun head{run.start, {run.moves.begin(), middle}};
    head.moves.back().rounding = 0;
    const Vec3 tip = head.moves.back().tip;
    const Vec3 above = tip + (retract - dot(tool_axis, tip)) * tool_axis;
    head.moves.push_back({above, MoveKind::retract});
    PathRun tail{above, {}};
    if (retract - dot(tool_axis, tip) > approach_height) {
        tail.moves.push_back({tip + approach_height * tool_axis, MoveKind::link});
    }
    tail.moves.push_back({tip, MoveKind::approach});
    tail.moves.insert(tail.moves.end(), middle, run.moves.end());
    return {std::move(head), std::move(tail)};
}

std::size_t lines_of(const PathRun& run) {
    std::size_t lines = 1;
    double rounding = 0;
    for (std::size_t i = 0; i < run.moves.size(); ++i) {
        lines += lines_of(run.moves[i], run.moves[i > 0 ? i - 1 : 0], rounding);
        if (run.moves[i].rounding > 0) rounding = run.moves[i].rounding;
    }
    return lines;
}

std::vector<PathRun> split_long_runs(const std::vector<PathRun>& runs, std::size_t lines, Vec3 tool_axis,
                                     double retract) {
    assert(lines >= 12);
    std::vector<PathRun> parts;
    for (const PathRun& run : runs) {
        PathRun rest = run;
        while (lines_of(rest) > lines) {
            const std::size_t count = first_part(rest, lines);
            auto [head, tail] = split_run(rest, count, tool_axis, retract);
            parts.push_back(std::move(head));
            rest = std::move(tail);
        }
        parts.push_back(std::move(rest));
    }
    return parts;
}

}  // namespace qchopper
