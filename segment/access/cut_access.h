// What no tool reaches of the two sides of a plane: the ingredients of the objective `unreachable`.
//
// mm2, on the samples of a piece (sampled_piece.h), for a tool of radius zero. Preconditions of all functions that take
// a piece: it has samples.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/access/access_sweep.h"
#include "segment/access/sampled_piece.h"
#include "segment/cut/cut_evaluation.h"

namespace qchopper {

// The sweep of a piece on all its caps, also those too small to carry it: they may carry a part of it. The piece must
// outlive it.
AccessSweep access_sweep(const Piece& piece, double tilt_deg);

// The area of the uncut scan, all its pieces together.
double scan_area_mm2(const Piece& piece);

// Of both sides, each on its best base.
double unreachable_mm2(const PlaneAccess& plane);

// Of one plane. O(samples x directions).
CutAccess cut_access(const Piece& piece, const Plane& plane, double tilt_deg);
// The same of the pieces that the plane really makes, those below fragment_volume_mm3 left out; nothing: it does not
// part the piece. What a side of several solids leaves out of reach is found no other way. O(triangles + samples x
// directions).
std::optional<double> unreachable_when_cut_mm2(const Piece& piece, const Plane& plane, double fragment_volume_mm3,
                                               double tilt_deg);
// Of planes with one normal, a unit vector; the offsets ascend.
std::vector<CutAccess> cut_access(const Piece& piece, Vec3 normal, std::span<const double> offsets, double tilt_deg);

}  // namespace qchopper
