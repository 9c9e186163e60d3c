// Offsets at even steps, then nudge(): O(points) per normal, besides the oriented box.

#include "segment/score/candidates.h"

#include <cassert>

#include "segment/cut/nudge.h"

namespace qchopper {

std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index, int count) {
    const Vec3 n = canonical({normal, 0}).normal;
    const Extent range = extent(*piece.mesh, n);
    std::vector<double> wanted;
    for (int k = 1; k <= count; ++k) wanted.push_back(range.low + range.size() * k / (count + 1));
    const std::vector<std::optional<Nudged>> nudged = nudge(piece, n, wanted);
    assert(nudged.size() == wanted.size());
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (!nudged[k]) continue;
        candidates.push_back({{n, nudged[k]->offset}, wanted[k], normal_index, static_cast<int>(k)});
    }
    return candidates;
}

std::vector<Candidate> candidate_planes(const Piece& piece, const CandidateOptions& options) {
    return candidate_planes(piece, oriented_box(piece.mesh->points), options);
}

std::vector<Candidate> candidate_planes(const Piece& piece, const OrientedBox& box, const CandidateOptions& options) {
    std::vector<Candidate> all;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Candidate> some =
            candidates_along(piece, box.axis[static_cast<std::size_t>(axis)], axis, options.offsets_per_normal);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

}  // namespace qchopper
