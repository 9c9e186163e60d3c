// The visible length of the seams: where joints show on the outer surface.
//
// mm. A seam is an edge between a cap and the old surface. It counts by the share of 64 fixed directions above the
// surface there along which nothing of the uncut scan is in the way, so that seams in cavities cost little
// (tests/segment/joint/seam_test.cpp).

#pragma once

#include <span>

#include "base/context.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct SeamLength {
    double mm = 0;          // of all seams
    double visible_mm = 0;  // the same, each point by its share of open directions
};

// Of the caps of all pieces that look against the normal of their cut, so that each seam counts once. Visibility is
// asked once per `step` mm of seam, in the order of the triangles. Throws Cancelled. O(triangles + asked rays).
SeamLength seam_length(std::span<const Piece> pieces, double step = 2, const Context& context = {});

}  // namespace qchopper
