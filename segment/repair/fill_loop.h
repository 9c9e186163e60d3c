// Triangles that close one loop of points in space, adding no point.

#pragma once

#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The triangles of least bend and area (P. Liepa, "Filling holes in meshes", 2003, as in CGAL), named by the numbers of
// the points in the loop; each runs along the loop in its direction. beyond[i] is the third corner of the triangle on
// the other side of the edge from loop[i] to the next. Nothing if there is no such surface.
std::vector<Triangle> fill_loop(const std::vector<Vec3>& loop, const std::vector<Vec3>& beyond);

}  // namespace qchopper
