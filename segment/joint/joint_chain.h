// The longest chain of joints of an assembly: how far the inaccuracy of glued faces can add up.
//
// Two pieces are off each other by no more than the joints of the shortest way between them, because every joint is
// closed. The chain is that way for the two pieces that are farthest apart (tests/segment/joint/joint_chain_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "segment/joint/piece_joints.h"

namespace qchopper {

struct JointChain {
    std::vector<std::size_t> pieces;  // indices along the way, from the smaller end; empty: there is no joint
    std::size_t joints() const { return pieces.empty() ? 0 : pieces.size() - 1; }
    // mm, by which the ends are off each other where each joint is off by `accuracy`: if all add up, and if they are
    // independent.
    double largest_deviation(double accuracy) const;
    double usual_deviation(double accuracy) const;
    bool operator==(const JointChain&) const = default;
};

// `pieces`: how many there are. Of equal chains the one of the smallest indices of its ends. Pieces that no way of
// joints connects are not compared. O(pieces x (pieces + joints)).
JointChain longest_chain(std::size_t pieces, std::span<const PieceJoint> joints);

}  // namespace qchopper
