// Moves offsets of planes away from the vertices, so that no vertex lies numerically on a plane.
//
// mm. The result is the middle of the widest vertex-free gap within 1e-7 of the piece's extent around the wanted
// offset. Of gaps equally wide (one vertex or one flat region on the plane, or within 1e-9 of the extent beside it) it
// is the one with the smaller cap, so that no thin layer stays on a flat region; then the nearer; then the lower. A
// stored offset must not be nudged again. The sweep, the cut and the report all use the nudged offset
// (tests/segment/cut/nudge_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/cut/piece.h"

namespace qchopper {

struct Extent {
    double low = 0;
    double high = 0;
    double size() const { return high - low; }
};

// Least and largest height of the points along a normal; +infinity and -infinity without points.
Extent extent(const TriangleMesh& mesh, Vec3 normal);

struct Nudged {
    double offset = 0;
    bool is_widened = false;  // no gap of 64 ulp was in the window: one ten times as wide was used
};

// One result per wanted offset, in their order. Nothing where the offset is not a finite number, outside the piece or
// within the window of its ends, within the window of a parallel cut that bounds it (the piece would be a thin layer),
// or where there is no gap. Precondition: the normal is canonical (plane.h). O(points log offsets), O(n log n) for the
// n points near an offset, and O(triangles) for each offset with gaps of equal width.
std::vector<std::optional<Nudged>> nudge(const Piece& piece, Vec3 normal, std::span<const double> wanted);

}  // namespace qchopper
