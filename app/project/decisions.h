// What was decided in a project, in order: cuts, discarded pieces, changes of weights, resets. Undo goes back in it,
// redo forward.
//
// Decisions that were undone are kept until something new is decided. Undo then redo is identity, and what stands
// depends only on the decisions in force (tests/app/project/decisions_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

struct WeightsChange {
    Weights weights;  // from now on
    bool operator==(const WeightsChange&) const = default;
};

// Takes all cuts and discarded pieces back; the weights stay.
struct Reset {
    bool operator==(const Reset&) const = default;
};

// A piece is left out: head rest, debris, table.
struct Discard {
    std::string piece;
    std::size_t after = 0;  // so many cuts stood; follows from its place among the decisions
    bool operator==(const Discard&) const = default;
};

using Decision = std::variant<Cut, WeightsChange, Reset, Discard>;

struct History {
    Weights weights_at_start;
    std::vector<Decision> decisions;
    std::size_t standing = 0;  // so many are in force; the rest was undone and can be redone
    bool operator==(const History&) const = default;
};

// "cut 3 on piece B", "discard of piece C", "change of weights", "reset".
std::string words(const Decision& decision);

// "cut 2 on piece B: best of 120 planes, total 3.929 (...); makes D, E".
std::string cut_line(const Cut& cut);

// "D, E and 2 fragments": what a cut made.
std::string makes(const Cut& cut);

std::vector<Cut> standing_cuts(const History& history);
std::vector<Discard> standing_discards(const History& history);
Weights standing_weights(const History& history);

// Adds a decision after those in force; those undone are gone.
void decide(History& history, Decision decision);

// The decision that undo would take back, and the one that redo would put in force again; nothing if there is none.
const Decision* to_undo(const History& history);
const Decision* to_redo(const History& history);

// Makes the cuts in force end in `cuts`, where a search goes on or turns to another branch: cuts at the end that it
// made and has given up are dropped, new ones are added.
void follow(History& history, const std::vector<Cut>& cuts);

}  // namespace qchopper
