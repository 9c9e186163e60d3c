// The beam between two rounds in the form in which it is saved: an interrupted search that resumes from it ends as if
// it had not been interrupted (tests/app/project/open_project_test.cpp).
//
// The segmentations of a beam have their first cuts in common: the cuts form a tree, in which each is kept once. Ranks
// and evaluations are not kept, because they follow from the pieces.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

struct BeamState {
    // A cut of the segmentation that ends with cuts[after - 1], or of the root if `after` is 0.
    struct Node {
        std::size_t after = 0;
        Cut cut;
        bool operator==(const Node&) const = default;
    };
    struct Branch {
        std::size_t last = 0;                  // as Node::after
        std::vector<std::string> passed_over;  // names of pieces that no candidate cuts
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
                             const std::vector<std::string>& passed_over);

// The cuts of a branch after those of the root, in order.
std::vector<Cut> cuts_of(const BeamState& state, const BeamState::Branch& branch);

}  // namespace qchopper
