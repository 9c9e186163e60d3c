// What lies inside what: points in solids, shells in shells.
//
// mm. Straight lines along an axis are followed through the mesh; line_crossing.h decides which triangles they cross,
// so a line never slips through an edge and never counts twice (tests/segment/mesh/containment_test.cpp). The mesh must
// be closed. One pass over the triangles each, interior_point a few more.

#pragma once

#include <optional>
#include <vector>

#include "segment/mesh/index_lists.h"
#include "segment/mesh/shells.h"

namespace qchopper {

// Triangles must face outwards. Of a point on the surface either may be said.
bool is_inside(const TriangleMesh& mesh, Vec3 point);

// A point far from the surface, so that it is in the same solid also when that is scanned or meshed anew. Nothing only
// if the mesh has no inside. Triangles must face outwards.
std::optional<Vec3> interior_point(const TriangleMesh& mesh);

// Per shell, the shells around it in ascending order. With `asked` only for the shells that are marked in it; the
// others have none. Orientation does not matter: a shell is inside another one when a ray from it meets that an odd
// number of times.
IndexLists shells_around(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& asked = {});

}  // namespace qchopper
