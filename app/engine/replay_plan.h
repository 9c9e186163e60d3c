// Makes the cuts of a plan again on another version of the same specimen: meshed anew, decimated, finer.
//
// Frames are aligned by the coordinates of the files, in mm. A piece is found again by its place in the BSP, by the
// point that lies inside it, and by its share of the volume. On the scan of the plan itself the pieces are the same bit
// for bit; on the same surface meshed anew volumes agree to 1e-6; on another version they differ by as much as the two
// scans differ there, which is reported (tests/app/engine/replay_plan_test.cpp).

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/store/plan.h"
#include "base/context.h"

namespace qchopper {

struct PlanFit {
    double max_volume_off = 0.05;  // largest difference of a piece's share of the whole, relative
    double max_box_off = 0.02;     // largest distance of either corner of the boxes, relative to the diagonal
    bool operator==(const PlanFit&) const = default;
};

// Why the plan cannot be of this specimen in this frame, without a full stop; empty: it can. O(points).
std::string misfit(const Plan& plan, const ScanSource& source, const TriangleMesh& scan, const PlanFit& fit = {});

struct PlanReplay {
    bool applies = false;            // to the last cut
    std::string why;                 // otherwise which cut or discarded piece, and the reason
    std::vector<std::string> notes;  // offsets that had to be nudged
    double largest_volume_off = 0;   // relative, over all pieces that the cuts made
};

// Adds the plan's cuts to an uncut segmentation, until one does not apply; that one is not made. Planes are evaluated
// with `settings`. Pieces that the plan discards are discarded at the same place among the cuts. `on_decision` is
// called after every cut and every discarded piece. Throws Cancelled; the segmentation then has the
// cuts before.
PlanReplay replay_plan(const Plan& plan, const ScanSource& source, Segmentation& segmentation,
                       const SearchSettings& settings, EvaluationCache& cache,
                       const std::function<void(const Segmentation&)>& on_decision, const Context& context,
                       const PlanFit& fit = {});

}  // namespace qchopper
