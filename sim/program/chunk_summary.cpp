// One pass over the steps.

#include "sim/program/chunk_summary.h"

namespace qchopper {
namespace {

ChunkSummary summarise(const ParsedProgram& program, const ProgramChunk& chunk) {
    ChunkSummary summary;
    summary.file = program.files[chunk.file];
    bool is_first = true;
    bool follows_line = false;
    for (std::size_t i = chunk.first; i < chunk.end; ++i) {
        const ProgramStep& step = program.steps[i];
        const bool is_rapid = step.kind == StepKind::joint_move || step.kind == StepKind::rapid_move;
        if (step.kind != StepKind::linear_move && !is_rapid) continue;
        ++summary.moves;
        if (is_rapid) {
            follows_line = false;
            continue;
        }
        const Vec3 tip{step.values[0], step.values[1], step.values[2]};
        if (is_first) {
            summary.first = tip;
            summary.box = {tip, tip};
        }
        if (follows_line) summary.length += norm(tip - summary.last);
        extend(summary.box, tip);
        summary.last = tip;
        is_first = false;
        follows_line = true;
    }
    return summary;
}

}  // namespace

std::vector<ChunkSummary> summarise_chunks(const ParsedProgram& program) {
    std::vector<ChunkSummary> summaries;
    for (const ProgramChunk& chunk : program.chunks) {
        if (!chunk.is_main) summaries.push_back(summarise(program, chunk));
    }
    return summaries;
}

}  // namespace qchopper
