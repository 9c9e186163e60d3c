// What a mm of seam costs at each point of a scan: the share of directions along which the point is seen.
//
// A seam in a cavity costs nothing, one on the open surface most (Luo et al. 2012, section 3.5, with visibility as the
// penalty). Values in [0, 1] per point of each piece's mesh (Piece::seam_cost). Every solid is asked alone: others do
// not hide it. The same for any number of threads (tests/segment/objectives/seam_cost_test.cpp).

#pragma once

#include <cstddef>
#include <span>

#include "base/context.h"
#include "segment/cut/cut_piece.h"

namespace qchopper {

constexpr std::size_t default_asked_points = 20'000;

// Of the directions of tool_directions.h that lie above the tangent plane at a point, the share along which nothing of
// its solid is in the way. About `asked` points of all pieces are asked, the same number in each stretch of memory; the
// others have the value of the nearest one along the edges, and those of a shell without any asked point 1.
// Precondition: the meshes are in memory order (order.h). Throws Cancelled. O(points) and asked x 132 rays.
void find_seam_costs(std::span<Piece> uncut, const Context& context = {}, std::size_t asked = default_asked_points);

// Gives the pieces that a cut made of `parted` its values, on new points those between the corners of the triangle that
// they lie in; nothing if it has none. O(triangles).
void pass_on_seam_costs(const Piece& parted, CutPieces& made);

}  // namespace qchopper
