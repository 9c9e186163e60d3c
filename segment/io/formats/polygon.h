// Splits a polygon in space into triangles without adding points.
//
// It is separate from segment/mesh/polygon.h and segment/cut/ear_clipping.h because those compute in plane coordinates:
// a projection rounds differently, so other ears would be found and other triangles be read from the same file.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Appends corners.size() - 2 triangles to `triangles`. Ears are found in the plane of the polygon's area vector, so
// that concave polygons are right too; a polygon without such a plane becomes a fan. Preconditions: at least three
// corners, each the index of a point. Tested by tests/segment/io/formats/polygon_test.cpp.
void split_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                   std::vector<Triangle>& triangles);

}  // namespace qchopper
