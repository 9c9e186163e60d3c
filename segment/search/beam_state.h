// The beam between two rounds as it is saved, so that a search that was interrupted ends as if it had not been.
//
// The segmentations of a beam have the cuts at their beginning in common; those are kept once, as a tree. Ranks and
// evaluations are not kept: they follow from the pieces (tests/app/project/open_project_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

struct BeamState {
    // A cut, made in the segmentation that ends in `after`: the root for 0, else after the cut cuts[after - 1].
    struct Node {
        std::size_t after = 0;
        Cut cut;
        bool operator==(const Node&) const = default;
    };
    struct Branch {
        std::size_t last = 0;                  // as Node::after
        std::vector<std::string> passed_over;  // pieces that no candidate parts
        bool operator==(const Branch&) const = default;
    };

    std::size_t from = 0;          // so many of the standing cuts make the root
    std::vector<Node> cuts;        // each after the one that it follows
    std::vector<Branch> branches;  // cheapest first; the first is the segmentation that stands
    std::optional<Branch> stuck;   // the cheapest that could neither go on nor was finished
    bool operator==(const BeamState&) const = default;
};

// Adds a branch for a segmentation that has the root's `from` cuts at its beginning.
BeamState::Branch branch_for(BeamState& state, const std::vector<Cut>& cuts,
                             const std::vector<std::string>& passed_over);

// The cuts of a branch after those of the root.
std::vector<Cut> cuts_of(const BeamState& state, const BeamState::Branch& branch);

}  // namespace qchopper
