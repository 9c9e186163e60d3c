// Splits a polygon in space into triangles, adding no point.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Appends corners.size() - 2 triangles to `triangles`, by cutting off ears in the polygon's mean plane, so that
// concave polygons come out right. A polygon that has no plane is split as a fan.
void split_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                   std::vector<Triangle>& triangles);

}  // namespace qchopper
