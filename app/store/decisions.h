// The decisions of a project in order: cuts, discarded pieces, setups, changes of weights, resets. Undo goes back in
// this list, redo forward.
//
// The first `committed` decisions are in force; the others were undone and are kept until something new is decided.
// Undo then redo is identity, and cuts, discards and weights depend only on the decisions in force
// (tests/app/store/decisions_test.cpp). All functions are O(decisions). Precondition of all that take a history:
// committed <= decisions.size().

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper {

struct WeightsChange {
    Weights weights;  // from then on
    bool operator==(const WeightsChange&) const = default;
};

// Some of the weights; the others keep their values.
struct GivenWeights {
    std::array<std::optional<double>, all_objectives.size()> weight = {};  // in the order of the table
    Weights over(const Weights& weights) const;
};

// Takes all cuts and discarded pieces back; the weights stay.
struct Reset {
    bool operator==(const Reset&) const = default;
};

// A piece is left out: head rest, debris, table.
struct Discard {
    std::string piece;      // its name
    std::size_t after = 0;  // number of cuts in force before; follows from its place among the decisions
    bool operator==(const Discard&) const = default;
};

// Those that one decision leaves out, at least one, all after the same cut.
using Discards = std::vector<Discard>;

// How a piece is laid and milled in place of what the program chooses. With nothing of it the program chooses again.
struct SetupOrder {
    std::string piece;                          // its name
    std::optional<int> base;                    // number of the base (segment/access/piece_access.h)
    std::optional<std::size_t> max_directions;  // of the tool
    std::vector<std::uint16_t> tools = {};      // numbers of those that may be used; empty: no other than the project's
    bool is_free() const { return !base && !max_directions && tools.empty(); }
    bool operator==(const SetupOrder&) const = default;
};

// Another plane for a cut of which no piece was cut since (segment/search/recut.h), because its pieces can be milled
// better so. No piece is discarded after this cut, and none of it or of a later cut has a setup of the operator's.
struct Replacement {
    Cut cut;  // in place of the one with its number
    bool operator==(const Replacement&) const = default;
};

using Decision = std::variant<Cut, WeightsChange, Reset, Discards, SetupOrder, Replacement>;

struct History {
    Weights weights_at_start;
    std::vector<Decision> decisions;
    std::size_t committed = 0;  // number of decisions in force; the others were undone and can be redone
    bool operator==(const History&) const = default;
};

// "cut 3 on piece B", "discard of piece C", "discard of pieces C, D", "setup of piece B", "replacement of cut 3 on
// piece B", "change of weights", "reset".
std::string describe(const Decision& decision);

// So many planes of a piece at most are judged by what they leave out of reach, or by the terms that are fast, before
// those that can win are evaluated by all terms (segment/search/access_rank.h, late_rank.h); 0 where all are evaluated
// whole.
std::size_t max_judged_planes(const SearchSettings& settings);

// "up to 10,560 planes, 32 of them evaluated whole", or "120 planes": among which a plane was chosen.
std::string describe_planes(std::size_t evaluated, const SearchSettings& settings);

// "cut 2 on piece B: best of 120 planes, total 3.929 (...); makes D, E". With the settings by which it was chosen.
std::string cut_line(const Cut& cut, const SearchSettings& settings);

// "D, E and 2 fragments": what a cut made.
std::string makes(const Cut& cut);

// Whether every replacement is of a cut that is in force before it and of which no piece was cut since. Of a history
// that came from a file; the functions below take it for granted.
bool are_replacements_possible(const History& history);

// Those in force: after the last reset, and the last change of weights; replacements in the place of their cuts.
std::vector<Cut> committed_cuts(const History& history);
std::vector<Discard> committed_discards(const History& history);
Weights committed_weights(const History& history);
// The last one of each piece that is neither cut nor discarded since, sorted by the names of the pieces.
std::vector<SetupOrder> committed_setup_orders(const History& history);
// That of one piece, which is free if there is none.
SetupOrder committed_setup_order(const History& history, const std::string& piece);

// Adds a decision after those in force and removes those that were undone.
void decide(History& history, Decision decision);

// The decision that undo would take back, and the one that redo would put in force again; nullptr if there is none.
const Decision* to_undo(const History& history);
const Decision* to_redo(const History& history);
// "Undo cut 3 on piece B", "Redo reset"; empty if there is nothing to undo or redo.
std::string undo_text(const History& history);
std::string redo_text(const History& history);

// Makes `cuts` the cuts in force, after a search has gone on or changed to another branch: cuts at the end that are not
// in `cuts` are dropped, new ones are added. Precondition: nothing but cuts was decided after the last cut that both
// have in common.
void follow(History& history, const std::vector<Cut>& cuts);

}  // namespace qchopper
