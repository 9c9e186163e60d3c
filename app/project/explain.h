// Explains a cut: ranks again all planes that could have been chosen for it.
//
// Offsets in mm along the normal, from the middle of the scan's box. Weights are those in force when the cut was
// decided; the piece is that before the cut (tests/app/cli/explain_test.cpp).

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
    std::optional<std::size_t> place;  // index of the chosen plane among them; nothing: it is the operator's own
    Ranked chosen;
    std::vector<Ranked> along_own_normal;  // without a place: planes along the normal of the chosen one, by offset
    bool is_best() const { return place && *place == 0; }
};

// A cut in force by its number, the last one for nothing. Throws InputError (use) if there is none.
const Cut& cut_to_explain(const Project& project, std::optional<int> number);

// Changes nothing but the cache. Precondition: `cut` is one of project.project().cuts. Throws InputError (config) if
// its piece does not exist before the cut, and what the import of the scan throws.
Explanation explain(OpenProject& project, const Cut& cut, const Context& context);

}  // namespace qchopper
