// Chooses cuts one after the other until the stop rules hold: the greedy search (Nicholson 2016, chapters 3 and 4).

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "segment/context.h"
#include "segment/mesh/rays.h"
#include "segment/search/segmentation.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct SearchSettings {
    Objectives objectives;
    CandidateOptions candidates;
    StopRules stop;
    std::size_t runners_up = 9;  // how many are kept beside the chosen one
    bool operator==(const SearchSettings&) const = default;
};

// All candidates of one piece, best first; ties within 1e-9 of the total go to the lower normal, then offset.
std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         const RayTree& scan_rays, const Context& context);

struct SearchEnd {
    bool is_finished = false;  // the stop rules hold
    std::string reason;        // in words
};

// Goes on from where the segmentation stands. `on_cut` is told after every decision, so that it can be saved.
// Throws Cancelled when asked to stop; the cuts made until then stand.
SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, const RayTree& scan_rays,
                 const FitsCell& fits_cell, const std::function<void(const Segmentation&)>& on_cut,
                 const Context& context);

}  // namespace qchopper
