// The objectives as reports show them: one table, and the format of their weights.

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.h"
#include "segment/objectives/objectives.h"

namespace qchopper {

struct ObjectiveTerm {
    const char* name;
    const char* title;  // of a row in a plot
    double Terms::*value;
    double Weights::*weight;
    std::size_t colour;  // index in the palette of the pieces, of a colour that is dark enough on white
    bool is_bounded;     // else a plot shows the better third only, because the worst are thousands of times worse
    double step;         // the least range of its axis
    int digits = 4;      // of its values in tables
};

inline constexpr std::array<ObjectiveTerm, all_objectives.size()> all_objective_terms{
    {{"face ratio", "Face ratio", &Terms::face_ratio, &Weights::face_ratio, 0, false, 0.01, 3},
     {"fragility", "Fragility", &Terms::fragility, &Weights::fragility, 6, true, 0.01},
     {"piece count", "Piece count", &Terms::piece_count, &Weights::piece_count, 9, false, 1, 0},
     {"undercut", "Undercut", &Terms::undercut, &Weights::undercut, 3, true, 0.01},
     {"unreachable", "Unreachable", &Terms::unreachable, &Weights::unreachable, 1, true, 0.001},
     {"parts", "Parts", &Terms::parts, &Weights::parts, 2, true, 0.01},
     {"utilization", "Utilization", &Terms::utilization, &Weights::utilization, 4, true, 0.01},
     {"connector", "Connector", &Terms::connector, &Weights::connector, 5, true, 0.01},
     {"seam", "Seam", &Terms::seam, &Weights::seam, 7, true, 0.01},
     {"symmetry", "Symmetry", &Terms::symmetry, &Weights::symmetry, 8, true, 0.001},
     {"structure", "Structure", &Terms::structure, &Weights::structure, 10, true, 0.0001, 6}}};

// Those that have a weight, and those of the thesis unless terms of Chopper take their place.
inline std::vector<ObjectiveTerm> objective_terms(const Weights& weights) {
    bool has_any_of_chopper = false;
    for (std::size_t i = first_of_chopper; i < all_objectives.size(); ++i)
        has_any_of_chopper = has_any_of_chopper || weights.*all_objectives[i].weight > 0;
    std::vector<ObjectiveTerm> terms;
    for (std::size_t i = 0; i < all_objective_terms.size(); ++i) {
        const ObjectiveTerm& term = all_objective_terms[i];
        if (weights.*term.weight > 0 || (i < always_named && !has_any_of_chopper)) terms.push_back(term);
    }
    return terms;
}

// "10", "0.5": at most three decimals.
inline std::string describe_weight(double weight) {
    std::string text = fixed(weight, 3);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace qchopper
