// The settings of a search: weights, candidates, stop rules, width of the beam.

#pragma once

#include <cstddef>

#include "segment/objectives/objectives.h"
#include "segment/search/candidates/candidates.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct SearchSettings {
    Objectives objectives;
    CandidateOptions candidates;
    StopRules stop;
    std::size_t runners_up = 9;  // how many candidates a cut records beside the chosen one
    std::size_t beam = 1;        // b: how many BSPs are kept per round
    double near = 0.06;          // of two candidates of one parent with one normal and offsets nearer than this share
                                 // of the piece's extent, the worse is culled; of no effect at b = 1
    bool operator==(const SearchSettings&) const = default;

    // Whether the pieces need samples (segment/access/sampled_piece.h).
    bool takes_samples() const { return stop.max_unreachable.has_value() || objectives.weights.unreachable > 0; }
    // Whether the scan is to be measured, and its points asked how well they are seen.
    bool measures_scan() const {
        return objectives.needs_sizes() || objectives.needs_seam() || objectives.weights.symmetry > 0;
    }
    // Whether pieces and evaluations made with these settings hold what the others need.
    bool needs_same(const SearchSettings& others) const {
        return takes_samples() == others.takes_samples() && measures_scan() == others.measures_scan() &&
               objectives.needs_sizes() == others.objectives.needs_sizes() &&
               objectives.needs_seam() == others.objectives.needs_seam() &&
               objectives.needs_connector() == others.objectives.needs_connector() &&
               objectives.needs_symmetry() == others.objectives.needs_symmetry() &&
               objectives.needs_structure() == others.objectives.needs_structure();
    }
    // Whether a search must save more than its segmentation to go on as if it had not been interrupted.
    bool has_state() const { return beam > 1 || stop.max_unreachable; }
};

}  // namespace qchopper
