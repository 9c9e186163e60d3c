// Candidates are grouped by normal; each group is one sweep, and the groups run in parallel. The cost is that of the
// sweeps (sweep.h) and of preparing the piece once (prepared.h).

#include "segment/score/evaluate.h"

#include <cassert>
#include <mutex>

#include "base/parallel.h"
#include "segment/score/sweep.h"

namespace qchopper {
namespace {

// Candidates [first, last) share a normal; their offsets ascend.
struct Group {
    std::size_t first;
    std::size_t last;
};

std::vector<Group> groups_of(std::span<const Candidate> candidates) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const bool continues = i > 0 && candidates[i].plane.normal == candidates[i - 1].plane.normal &&
                               candidates[i].plane.offset > candidates[i - 1].plane.offset;
        if (!continues) groups.push_back({i, i});
        groups.back().last = i + 1;
    }
    return groups;
}

}  // namespace

std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context,
                                                       const std::array<Vec3, 3>* box_axes) {
    std::vector<std::optional<CutEvaluation>> evaluations(candidates.size());
    context.check_cancelled();
    const PreparedPiece prepared = prepare(piece, objectives, box_axes);
    std::mutex reporting;
    std::size_t done = 0;
    const std::vector<Group> groups = groups_of(candidates);
    parallel_for(0, groups.size(), [&](std::size_t g) {
        context.check_cancelled();
        const auto [first, last] = groups[g];
        std::vector<double> offsets;
        for (std::size_t i = first; i < last; ++i) offsets.push_back(candidates[i].plane.offset);
        auto swept = sweep(prepared, candidates[first].plane.normal, offsets, objectives);
        assert(swept.size() == last - first);
        std::move(swept.begin(), swept.end(), evaluations.begin() + static_cast<std::ptrdiff_t>(first));
        const std::lock_guard lock(reporting);
        context.progress("planes evaluated", done += last - first, candidates.size());
    });
    return evaluations;
}

}  // namespace qchopper
