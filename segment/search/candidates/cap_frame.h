// The frame of the caps of a piece, and the normals that follow from them: planes along them leave caps in which a sawn
// block can end.
//
// mm. Directions within same_direction_rad of each other, up to sign, count once. Caps are those that the piece owns;
// all normals are canonical (tests/segment/search/candidates/cap_frame_test.cpp).

#pragma once

#include <optional>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/plane.h"
#include "segment/search/candidates/candidates.h"

namespace qchopper {

constexpr double same_direction_rad = 1e-4;

// The box of the piece along its caps: one axis is the normal of the most cap area, another that of the most area at
// right angles to it, or else along the smallest rectangle across the first. Longest extent first, as in
// oriented_box.h. Nothing for a piece without caps. O(points + triangles).
std::optional<OrientedBox> box_along_caps(const Piece& piece);

// The box along which a piece is cut for size and through its middle: box_along_caps() where blocks end in caps and the
// piece has one, else its own.
OrientedBox box_for_cuts(const Piece& piece, const OrientedBox& own, const CandidateOptions& options);

// The normals of the caps, the cross products of those that are not parallel, and the axes of box_along_caps(), each
// once; none for a piece without caps. O(points + triangles + caps squared).
std::vector<Vec3> normals_along_caps(const Piece& piece);

// A normal that is within same_direction_rad of parallel or perpendicular to a cap of the piece, made so; another as it
// is.
Vec3 snapped(Vec3 normal, const std::vector<Vec3>& caps);

// Whether a normal is parallel or perpendicular to all of these, within same_direction_rad.
bool is_along(Vec3 normal, const std::vector<Vec3>& caps);

// The normals of the caps, that with the most area first.
std::vector<Vec3> cap_normals(const Piece& piece);

}  // namespace qchopper
