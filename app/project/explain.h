// Why a cut lies where it lies: all planes that could have been chosen, with the objective values that they had.
//
// Offsets in mm along the normal, from the middle of the scan's box. Values are those of the weights that stood when
// the cut was decided; the piece is that before the cut.

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/project/open_project.h"

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

// A cut that stands, by its number; the last one without. Throws InputError (use) if there is none.
const Cut& cut_to_explain(const Project& project, std::optional<int> number);

// Changes nothing but the cache. Throws InputError (config) if the piece is not there before the cut.
Explanation explain(OpenProject& project, const Cut& cut, const Context& context);

}  // namespace qchopper
