// Triangles that close one loop of points in space, adding no point.

#pragma once

#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The triangles with the least dihedral angles and area (P. Liepa, "Filling holes in meshes", 2003, as in CGAL). Their
// corners are positions in the loop, ascending, so each triangle is oriented as the loop runs. beyond[i], one per
// point, is the third corner of the triangle on the other side of the edge from loop[i] to the next point. Empty if no
// surface is found.
std::vector<Triangle> fill_loop(const std::vector<Vec3>& loop, const std::vector<Vec3>& beyond);

}  // namespace qchopper
