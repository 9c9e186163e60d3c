// Makes the cuts of a plan again on another version of the same specimen: meshed anew, decimated, finer.
//
// Frames are aligned by the coordinates of the files. A piece is found again by its place in the BSP, by the point that
// lies inside it, and by its share of the volume. On the very scan of the plan the pieces are the same bit for bit; on
// the same surface meshed anew volumes agree to 1e-6; on another version they differ by what the two scans differ by
// there, which is told (tests/app/project/replay_plan_test.cpp).

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/project/plan.h"
#include "base/context.h"

namespace qchopper {

struct PlanFit {
    double most_volume_off = 0.05;  // of a piece's share of the whole, relative
    double most_box_off = 0.02;     // of the box's diagonal, at either corner of the box
    bool operator==(const PlanFit&) const = default;
};

// Why the plan cannot be of this specimen in this frame; empty: it can.
std::string misfit(const Plan& plan, const ScanSource& source, const TriangleMesh& scan, const PlanFit& fit = {});

struct PlanReplay {
    bool applies = false;            // to the last cut
    std::string why;                 // not: which cut or discarded piece and why, in words
    std::vector<std::string> notes;  // offsets that had to be nudged
    double largest_volume_off = 0;   // relative, over all pieces that the cuts made
};

// Adds the plan's cuts to an uncut segmentation, until one does not apply; that one is not made. The operator's
// settings evaluate the planes. What the plan discards is discarded at the same place among the cuts. `on_decision` is
// told after every cut and every discarded piece.
PlanReplay replay_plan(const Plan& plan, const ScanSource& source, Segmentation& segmentation,
                       const SearchSettings& settings, EvaluationCache& book,
                       const std::function<void(const Segmentation&)>& on_decision, const Context& context,
                       const PlanFit& fit = {});

}  // namespace qchopper
