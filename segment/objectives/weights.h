// The weights of the objectives, their values for one cut, and one table of both.
//
// Options, files, reports and the total go by the table: an objective is a field of each struct and a row of it.

#pragma once

#include <array>

namespace qchopper {

struct Weights {
    double face_ratio = 10;
    double fragility = 5;
    double piece_count = 50;
    double undercut = 10;
    double unreachable = 0;  // above 0 the pieces need samples (sampled_piece.h)
    double parts = 0;        // those from here on: Luo et al. 2012, terms of Chopper (objectives.h)
    double utilization = 0;
    double connector = 0;
    double seam = 0;
    double symmetry = 0;
    double structure = 0;  // above 0 the pieces need the stress of the scan (Piece::stress)
    bool operator==(const Weights&) const = default;
};

// One candidate's or one cut's values, not yet weighted, and their weighted sum. None is negative or infinite.
struct Terms {
    double face_ratio = 0;
    double fragility = 0;
    double piece_count = 0;
    double undercut = 0;
    double unreachable = 0;  // share of the scan's area, over all pieces; 0 without samples
    double parts = 0;        // boxes that all pieces need / boxes that the uncut scan needs; 0 without a print volume
    double utilization = 0;  // in [0, 1]: 1 - volume / volume of the boxes, of the worst piece
    double connector = 0;
    double seam = 0;
    double symmetry = 0;
    double structure = 0;  // tension and shear on the sections by the strength; 0 without a load
    double total = 0;
    bool operator==(const Terms&) const = default;
};

struct ObjectiveField {
    const char* key;  // in options and files
    double Weights::*weight;
    double Terms::*value;
    bool can_forbid;  // its 1 says "not wanted": such cuts may be forbidden (Objectives::forbidden)
};

inline constexpr std::array<ObjectiveField, 11> all_objectives{
    {{"face_ratio", &Weights::face_ratio, &Terms::face_ratio, false},
     {"fragility", &Weights::fragility, &Terms::fragility, true},
     {"piece_count", &Weights::piece_count, &Terms::piece_count, false},
     {"undercut", &Weights::undercut, &Terms::undercut, false},
     {"unreachable", &Weights::unreachable, &Terms::unreachable, false},
     {"parts", &Weights::parts, &Terms::parts, false},
     {"utilization", &Weights::utilization, &Terms::utilization, false},
     {"connector", &Weights::connector, &Terms::connector, true},
     {"seam", &Weights::seam, &Terms::seam, false},
     {"symmetry", &Weights::symmetry, &Terms::symmetry, false},
     {"structure", &Weights::structure, &Terms::structure, false}}};

// Those that every file and report names; the others only where they have a weight.
constexpr std::size_t always_named = 4;
constexpr std::size_t first_of_chopper = 5;

inline double weighted_sum(const Terms& terms, const Weights& weights) {
    double sum = 0;
    for (const ObjectiveField& field : all_objectives) sum += weights.*field.weight * terms.*field.value;
    return sum;
}

}  // namespace qchopper
