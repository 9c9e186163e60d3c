// Explains a cut: ranks again all planes that could have been chosen for it.
//
// Offsets in mm along the normal, from the middle of the scan's box. Weights are those in force when the cut was
// decided; the piece is that before the cut (tests/app/cli/explain_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/engine/open_project.h"

namespace qchopper {

// What of the surface that is out of reach a plane opens: areas in mm2 on the samples of the search, each piece on its
// best base, along all directions within the largest tilt.
struct OpenedSurface {
    double piece_mm2 = 0;   // of the piece before the cut, its caps included
    double scan_mm2 = 0;    // of the scan, what is ignored left out
    double before_mm2 = 0;  // out of reach of the piece
    double after_mm2 = 0;   // out of reach of its two sides
    // The planes of all normals but the chosen one's, as the sweep judges them (segment/access/access_sweep.h).
    std::size_t other_normals = 0;
    std::size_t other_planes = 0;
    double best_other_after_mm2 = 0;
    double opened_share() const { return (before_mm2 - after_mm2) / piece_mm2; }  // below 0: it hides surface
    double best_other_share() const { return (before_mm2 - best_other_after_mm2) / piece_mm2; }
};

constexpr std::size_t listed_planes = 10;

struct Explanation {
    Cut cut;
    Objectives objectives;             // with the weights of that decision
    std::vector<Ranked> ranked;        // all candidates, best first
    std::vector<std::size_t> listed;   // of them the best ten that are more than one step of the offsets apart
    std::optional<std::size_t> place;  // index of the chosen plane among them; nothing: it is none of them now
    Ranked chosen;
    std::string proposer;  // the method that proposed the chosen plane (proposer_of); empty: none
    std::vector<Ranked>
        along_own_normal;  // without a place among the normals: planes along the normal of the chosen one, by offset
    std::optional<OpenedSurface> opened;  // nothing where surface out of reach has no weight
    std::size_t max_judged = 0;           // planes; 0 as well then
    // The best of the others by its total; null if there is none. And how many of them cost less than the chosen one.
    const Ranked* best_other() const;
    std::size_t cheaper() const;
};

// A cut in force by its number, the last one for nothing. Throws InputError (use) if there is none.
const Cut& cut_to_explain(const Project& project, std::optional<int> number);

// Changes nothing but the cache. Precondition: `cut` is one of project.project().cuts. Throws InputError (config) if
// its piece does not exist before the cut, and what the import of the scan throws.
Explanation explain(OpenProject& project, const Cut& cut, const Context& context);

}  // namespace qchopper
