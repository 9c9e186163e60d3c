// Every offset along every axis is counted, O(offsets).

#include "segment/search/candidates/size_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double middle_half = 0.5;

// The size of a part of a box along one axis.
Vec3 shortened(Vec3 size, std::size_t axis, double share) {
    double& length = axis == 0 ? size.x : axis == 1 ? size.y : size.z;
    length *= share;
    return size;
}

}  // namespace

std::set<std::pair<std::size_t, std::size_t>> candidates_for_size(const OrientedBox& box,
                                                                  const CandidateOptions& options,
                                                                  const BlocksNeeded& too_large_for) {
    std::set<std::pair<std::size_t, std::size_t>> planes;
    if (!too_large_for) return planes;
    const Vec3 size = box.size();
    const bool is_box_too_large = too_large_for(size) > 1;
    double fewest = infinite;
    for (std::size_t axis = 0; axis < (is_box_too_large ? 3U : 1U); ++axis) {
        const std::vector<double> shares = offset_shares(size[static_cast<int>(axis)], options);
        for (std::size_t k = 0; k < shares.size(); ++k) {
            const double share = shares[k];
            if (!is_box_too_large && std::abs(share - 0.5) > middle_half / 2) continue;
            const double blocks =
                too_large_for(shortened(size, axis, share)) + too_large_for(shortened(size, axis, 1 - share));
            if (blocks < fewest) planes.clear();
            fewest = std::min(fewest, blocks);
            if (blocks == fewest && blocks < infinite) planes.emplace(axis, k);
        }
    }
    return planes;
}

}  // namespace qchopper
