// Why a cut lies where it lies: what every plane that was considered would have cost, and how the chosen one compares.
//
// Offsets in mm along the normal, from the middle of the scan's box. Terms are priced again with the weights that stood
// when the cut was decided.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "segment/picture/plot.h"

namespace qchopper {

struct Explanation {
    Cut cut;
    Objectives objectives;             // with the weights of that decision
    std::vector<Ranked> ranked;        // all candidates, best first
    std::optional<std::size_t> place;  // of the chosen plane among them; nothing: a plane of the operator's own
    Ranked chosen;
    std::vector<Ranked> beside;  // candidates along the operator's own normal, by offset
    bool is_best() const { return place && *place == 0; }
};

// In words, ending in a full stop: how the chosen plane compares with the next or with the best.
std::string verdict(const Explanation& explanation);

// Head and rows: the ten best, and the chosen plane if it is not among them.
std::vector<std::vector<std::string>> table(const Explanation& explanation);

Plot plot(const Explanation& explanation, const std::string& project);

// The one JSON document, with what is discarded in the project; `picture` is where the plot was written.
std::string document(const Explanation& explanation, const Project& project, const std::string& picture);

}  // namespace qchopper
