// What the setups of its pieces say of a cut after the search, and what became of it.
//
// Values only; mm2. Kept in project.json, so that work that was interrupted goes on with the next cut.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace qchopper {

// Of all pieces that one cut makes, by their setups: height fields, few directions and holder.
struct MilledSurface {
    double unreachable_mm2 = 0;
    double area_mm2 = 0;  // without the bases
    double share() const { return area_mm2 > 0 ? std::min(1.0, unreachable_mm2 / area_mm2) : 0; }
    bool operator==(const MilledSurface&) const = default;
};

enum class ReviewOutcome {
    replaced,     // by the best of the other planes
    kept,         // no other plane leaves enough less, or none keeps the stop rules
    carries_cut,  // a piece of it was cut further: another plane would take those cuts back
    decided       // by the operator: the plane, or what becomes of a piece of this or a later cut
};

struct CutReview {
    std::int32_t cut = 0;
    std::string piece;  // that it divides
    ReviewOutcome outcome = ReviewOutcome::kept;
    std::size_t planes = 0;  // others that were tried and keep the stop rules that held
    MilledSurface before;
    MilledSurface best;  // of those; with none as before
    bool operator==(const CutReview&) const = default;
};

struct SetupReview {
    std::vector<CutReview> cuts;  // those asked, in their order
    bool are_cuts_asked = false;  // all of them: what remains is to cut pieces again
    bool is_done = false;         // false: the work was interrupted and goes on
    bool operator==(const SetupReview&) const = default;
};

}  // namespace qchopper
