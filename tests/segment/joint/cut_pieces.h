// Segmentations that the tests of joints and of the assembly start from.

#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "segment/cut/nudge.h"
#include "segment/search/segmentation.h"
#include "tests/pieces.h"

namespace qchopper {

// Cuts a piece of the segmentation at about this plane; false if the plane misses it.
inline bool cut_at(Segmentation& segmentation, const std::string& piece, const Plane& wanted) {
    for (const Piece& p : segmentation.pieces) {
        if (p.name != piece) continue;
        const std::vector<double> offsets{wanted.offset};
        const auto nudged = nudge(p, wanted.normal, offsets);
        if (!nudged[0]) return false;
        Cut cut;
        cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
        cut.piece = piece;
        cut.chosen.plane = {wanted.normal, nudged[0]->offset};
        return apply(segmentation, cut, 0);
    }
    return false;
}

// Cuts at random planes, each through a random piece.
inline Segmentation cut_randomly(const TriangleMesh& mesh, int cuts, std::mt19937& random) {
    Segmentation segmentation = uncut(mesh, 0);
    std::uniform_real_distribution<double> share(0.2, 0.8);
    for (int tries = 0; tries < 8 * cuts && static_cast<int>(segmentation.cuts.size()) < cuts; ++tries) {
        const Piece& piece = segmentation.pieces[random() % segmentation.pieces.size()];
        const Vec3 normal = random_normal(random);
        const Extent range = extent(*piece.mesh, normal);
        cut_at(segmentation, piece.name, {normal, range.low + share(random) * range.size()});
    }
    return segmentation;
}

}  // namespace qchopper
