// Binary searches by the ends of the steps.

#include "sim/cell/program_run.h"

#include <algorithm>
#include <cassert>

#include "devices/wire/program_block.h"

namespace qchopper {
namespace {

using Step = std::vector<RunStep>::const_iterator;

// The first step that ends after a moment; the last one where none does.
Step step_at(const JobRun& run, double at_s) {
    assert(!run.steps.empty());
    const Step found = std::ranges::upper_bound(run.steps, at_s, {}, &RunStep::end_s);
    return found == run.steps.end() ? found - 1 : found;
}

double begin_of(const JobRun& run, Step step) {
    return step == run.steps.begin() ? 0 : (step - 1)->end_s;
}

}  // namespace

RunPlace place_at(const JobRun& run, double at_s) {
    const Step step = step_at(run, at_s);
    const Vec3 from = step == run.steps.begin() ? step->tip : (step - 1)->tip;
    const double begin_s = begin_of(run, step);
    const double whole_s = step->end_s - begin_s;
    const double share = whole_s > 0 ? std::clamp((at_s - begin_s) / whole_s, 0.0, 1.0) : 1.0;
    return {step->block, step->tool, from + share * (step->tip - from)};
}

double line_end(const JobRun& run, double at_s) {
    Step step = step_at(run, at_s);
    const bool begins_here = step == run.steps.begin() || (step - 1)->block != step->block;
    if (begins_here && at_s <= begin_of(run, step)) return at_s;
    while (step + 1 != run.steps.end() && (step + 1)->block == step->block) ++step;
    return std::max(at_s, step->end_s);
}

std::optional<double> begin_of_block(const JobRun& run, std::uint32_t block, double from_s) {
    const auto begin = std::ranges::lower_bound(run.steps, from_s, {}, &RunStep::end_s);
    for (Step step = begin; step != run.steps.end(); ++step) {
        const bool is_same_file = chunk_of_block(step->block) == chunk_of_block(block);
        if (is_same_file && step->block >= block && begin_of(run, step) >= from_s) return begin_of(run, step);
    }
    return std::nullopt;
}

}  // namespace qchopper
