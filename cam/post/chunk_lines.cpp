// One pass over the moves.

#include "cam/post/chunk_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/box.h"
#include "base/text.h"

namespace qchopper {
namespace {

std::string box_words(const Box& box) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
        text +=
            (i > 0 ? ", " : "") + std::string(1, "XYZ"[i]) + " " + fixed(box.min[i], 2) + " to " + fixed(box.max[i], 2);
    }
    return text;
}

bool starts_from_home(const Program& program, const RunRange& range) {
    const ProgramOperation& operation = program.operations[range.operation];
    return range.first == 0 || operation.runs[range.first].starts_from_home;
}

}  // namespace

void describe_chunk(const Program& program, const CellMachine& machine, const RunRange& range, std::size_t order,
                    std::size_t total, ProgramLines& text) {
    const ProgramOperation& operation = program.operations[range.operation];
    const CuttingTool& tool = machine.tools[operation.tool];
    Box box;
    std::size_t moves = 0;
    double seconds = 0;
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        const ProgramRun& run = operation.runs[r];
        if (r == range.first) box = {run.start, run.start};
        moves += run.moves.size();
        Vec3 from = run.start;
        for (const ProgramMove& move : run.moves) {
            seconds += norm(move.tip - from) / std::max(move.speed, 1e-3);
            from = move.tip;
        }
        for (int i = 0; i < 3; ++i) {
            const auto add = [&](double value) {
                box.min[i] = std::min(box.min[i], value);
                box.max[i] = std::max(box.max[i], value);
            };
            add(run.start[i]);
            for (const ProgramMove& move : run.moves) add(move.tip[i]);
        }
    }
    text.comment("chunk " + std::to_string(order + 1) + " of " + std::to_string(total));
    text.comment("direction " + std::to_string(operation.orientation + 1));
    text.comment("tool " + std::to_string(tool.number) + ", " + tool.name);
    text.comment(std::string("operation ") + to_word(operation.kind));
    text.comment("moves of runs: " + std::to_string(moves) + ", " + fixed(seconds, 0) + " s at their speeds");
    text.comment("box of the tip in mm: " + box_words(box));
    text.comment(std::string("start from home: ") +
                 (starts_from_home(program, range) ? "free" : "not free, see the chunks before"));
}

std::vector<WrittenMove> written_moves(const ProgramRun& run, const std::function<std::string(Vec3)>& position) {
    std::vector<WrittenMove> written;
    std::string here = position(run.start);
    const auto position_of = [&](std::size_t i) {
        return i < run.moves.size() ? position(run.moves[i].tip) : std::string();
    };
    std::string next = position_of(0);
    for (std::size_t i = 0; i < run.moves.size();) {
        const ProgramMove& move = run.moves[i];
        std::string own = std::move(next);
        double rounding = move.rounding;
        for (next = position_of(++i); next == own; next = position_of(++i)) {
            rounding = std::min(rounding, run.moves[i].rounding);
        }
        if (own == here) continue;
        here = own;
        written.push_back({move.tip, std::move(own), move.speed, i < run.moves.size() ? rounding : 0});
    }
    return written;
}

double rounded_down(double value, double unit) {
    return unit * std::floor(value / unit + 1e-6);
}

}  // namespace qchopper
