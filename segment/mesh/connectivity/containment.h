// Decides which points lie inside a solid and which shells inside others.
//
// mm. Precondition of all: the mesh is closed (edges.h); is_inside and interior_point need triangles that face outwards
// as well. A line through an edge or a vertex is counted once (line_crossing.h,
// tests/segment/mesh/connectivity/containment_test.cpp).

#pragma once

#include <optional>
#include <vector>

#include "segment/mesh/connectivity/index_lists.h"
#include "segment/mesh/connectivity/shells.h"

namespace qchopper {

// Whether the point lies inside the solid. For a point on the surface either may be returned. O(triangles).
bool is_inside(const TriangleMesh& mesh, Vec3 point);

// A point inside, far from the surface, so that it lies in the same solid also when that is scanned or meshed anew.
// Nothing if none is found: the mesh has no volume, or is thinner than a grid of 256 x 256 lines. O(triangles) for each
// of up to nine passes.
std::optional<Vec3> interior_point(const TriangleMesh& mesh);

// One list per shell: the shells around it, ascending. `shells` are those of the mesh. `is_selected` has one flag per
// shell, or is empty: then all are selected; the lists of the others are empty. Orientation does not matter: a shell is
// inside another one when a ray from it meets that an odd number of times. Two passes over the triangles.
IndexLists shells_around(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& is_selected = {});

}  // namespace qchopper
