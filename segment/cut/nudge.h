// Moves wanted offsets off the vertices, so that no vertex lies numerically on a plane.
//
// The offset becomes the middle of the widest vertex-free gap within 1e-7 of the piece's extent around the wanted one.
// Of gaps equally wide (one vertex or one flat region on the plane, or within 1e-9 of the extent beside it) the one
// with the smaller cap, so that no skin stays on a flat region; then the nearer; then the lower. A stored offset is
// never nudged again. The sweep, the cut and the report all use the nudged offset (tests/segment/cut/nudge_test.cpp).

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

// Least and largest height of the mesh along a normal.
Extent extent(const TriangleMesh& mesh, Vec3 normal);

struct Nudged {
    double offset = 0;
    bool is_widened = false;  // no gap of 64 ulp was near enough: the window was taken ten times as wide
};

// One answer per wanted offset, in their order. Nothing where the offset misses: within the window of the piece's
// ends, or of a parallel cut that bounds it (no wafers). The normal must be canonical (plane.h).
std::vector<std::optional<Nudged>> nudge(const Piece& piece, Vec3 normal, std::span<const double> wanted);

}  // namespace qchopper
