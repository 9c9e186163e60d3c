// The objectives as reports show them: one table, and the format of their weights.

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "base/text.h"
#include "segment/score/objectives.h"

namespace qchopper {

struct ObjectiveTerm {
    const char* name;
    const char* title;  // of a row in a plot
    double Terms::*value;
    double Weights::*weight;
    std::size_t colour;  // index in the palette of the pieces, of a colour that is dark enough on white
    bool is_bounded;     // else a plot shows the better third only, because the worst are thousands of times worse
    double step;         // the least range of its axis
};

inline constexpr std::array<ObjectiveTerm, 5> all_objective_terms{
    {{"face ratio", "Face ratio", &Terms::face_ratio, &Weights::face_ratio, 0, false, 0.01},
     {"fragility", "Fragility", &Terms::fragility, &Weights::fragility, 6, true, 0.01},
     {"piece count", "Piece count", &Terms::piece_count, &Weights::piece_count, 9, false, 1},
     {"undercut", "Undercut", &Terms::undercut, &Weights::undercut, 3, true, 0.01},
     {"unreachable", "Unreachable", &Terms::unreachable, &Weights::unreachable, 1, true, 0.001}}};

// Those of the thesis, and what is out of reach where it has a weight: without, it is not computed.
inline std::span<const ObjectiveTerm> objective_terms(const Weights& weights) {
    const std::span<const ObjectiveTerm> all = all_objective_terms;
    return weights.unreachable > 0 ? all : all.first(all.size() - 1);
}

// "10", "0.5": at most three decimals.
inline std::string describe_weight(double weight) {
    std::string text = fixed(weight, 3);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace qchopper
