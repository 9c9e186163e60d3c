// The beam between two rounds in the form in which it is saved: an interrupted search that resumes from it ends as if
// it had not been interrupted (tests/app/engine/open_project_test.cpp).
//
// The segmentations of a beam have their first cuts in common: the cuts form a tree, in which each is kept once. Ranks
// and evaluations are not kept, because they follow from the pieces. Reverted trials are, because the same cuts later
// would be chosen by what other pieces have become since.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

// Cuts of a piece on trial that did not make it better and were reverted (trial.h).
struct RevertedTrial {
    std::string piece;
    int cuts = 0;               // how many were made; 0: no cut can gain enough
    double before_mm2 = 0;      // unreachable area of the piece
    double after_mm2 = 0;       // of the pieces that the cuts made
    bool is_cut_short = false;  // by max_cuts
    bool holds = false;         // every piece that the cuts made held the rules: kept if few others break one (trial.h)
    bool operator==(const RevertedTrial&) const = default;
};

struct BeamState {
    // A cut of the segmentation that ends with cuts[after - 1], or of the root if `after` is 0.
    struct Node {
        std::size_t after = 0;
        Cut cut;
        bool operator==(const Node&) const = default;
    };
    struct Branch {
        std::size_t last = 0;                      // as Node::after
        std::vector<std::string> passed_over;      // names of pieces that no candidate cuts or no trial makes better
        std::vector<RevertedTrial> reverted = {};  // of those for which cuts were on trial
        bool operator==(const Branch&) const = default;
    };

    std::size_t from = 0;          // the root has so many of the committed cuts
    std::vector<Node> cuts;        // each after the one that it follows
    std::vector<Branch> branches;  // cheapest first; the first is that of the committed cuts
    std::optional<Branch> stuck;   // the cheapest that is neither finished nor can be cut further
    bool operator==(const BeamState&) const = default;
};

// Adds the cuts of a segmentation to the tree and returns its branch. Precondition: its first state.from cuts are those
// of the root.
BeamState::Branch branch_for(BeamState& state, const std::vector<Cut>& cuts,
                             const std::vector<std::string>& passed_over, const std::vector<RevertedTrial>& reverted);

// The cuts of a branch after those of the root, in order.
std::vector<Cut> cuts_of(const BeamState& state, const BeamState::Branch& branch);

}  // namespace qchopper
