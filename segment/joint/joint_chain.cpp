// Breadth-first search from every piece.

#include "segment/joint/joint_chain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace qchopper {
namespace {

using Neighbours = std::vector<std::vector<std::size_t>>;

// The shortest ways from one piece, each piece by the one before it; nothing: it is not reached.
struct Ways {
    std::vector<std::optional<std::size_t>> before;
    std::vector<std::size_t> joints;
};

Ways ways_from(std::size_t start, const Neighbours& neighbours) {
    Ways ways{std::vector<std::optional<std::size_t>>(neighbours.size()),
              std::vector<std::size_t>(neighbours.size(), 0)};
    ways.before[start] = start;
    std::vector<std::size_t> reached{start};
    for (std::size_t next = 0; next < reached.size(); ++next) {
        const std::size_t from = reached[next];
        for (const std::size_t to : neighbours[from]) {
            if (ways.before[to]) continue;
            ways.before[to] = from;
            ways.joints[to] = ways.joints[from] + 1;
            reached.push_back(to);
        }
    }
    return ways;
}

}  // namespace

double JointChain::largest_deviation(double accuracy) const {
    return static_cast<double>(joints()) * accuracy;
}

double JointChain::usual_deviation(double accuracy) const {
    return std::sqrt(static_cast<double>(joints())) * accuracy;
}

JointChain longest_chain(std::size_t pieces, std::span<const PieceJoint> joints) {
    Neighbours neighbours(pieces);
    for (const PieceJoint& joint : joints) {
        assert(joint.below < pieces && joint.above < pieces);
        neighbours[joint.below].push_back(joint.above);
        neighbours[joint.above].push_back(joint.below);
    }
    for (std::vector<std::size_t>& of_piece : neighbours) std::sort(of_piece.begin(), of_piece.end());
    JointChain longest;
    for (std::size_t start = 0; start < pieces; ++start) {
        const Ways ways = ways_from(start, neighbours);
        const auto end = std::max_element(ways.joints.begin(), ways.joints.end());
        if (*end <= longest.joints()) continue;
        longest.pieces.clear();
        auto at = static_cast<std::size_t>(end - ways.joints.begin());
        for (; at != start; at = *ways.before[at]) longest.pieces.push_back(at);
        longest.pieces.push_back(start);
        std::reverse(longest.pieces.begin(), longest.pieces.end());
    }
    return longest;
}

}  // namespace qchopper
