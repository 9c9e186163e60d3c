// The foam that no tool of some directions removes, point by point: the reference of the foam in mapped_access()
// (cam/setup/mapped_access.h).
//
// mm, mm3.

#pragma once

#include <span>

#include "base/pose.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// Volume (mm3) of the points of a box that lie below the surface in every map: what no tool of these directions
// removes, the piece included. The points form a grid of the given step about the middle of the box, each standing for
// an equal share of it. The box reaches from the origin of its frame to `box_size`. Preconditions: at least one map,
// all of the same piece, step > 0. O(points * maps).
double remaining_volume(std::span<const HeightField> maps, Vec3 box_size, const Pose& box_in_piece, double step);

}  // namespace qchopper
