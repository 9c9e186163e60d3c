// Is a point in a solid, and which point of a solid lies deep in it?
//
// Lengths are millimetres. Straight lines along an axis are followed through the mesh; which line crosses which
// triangle is decided per edge, the same from both sides, so a line never slips through or counts twice
// (tests/segment/mesh/inside_test.cpp). Linear in the mesh.

#pragma once

#include <optional>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

bool contains(const TriangleMesh& mesh, Vec3 point);

// A point far from the surface, so that it is in the same solid also when that is scanned or meshed anew. Nothing only
// if the mesh has no inside.
std::optional<Vec3> deep_point(const TriangleMesh& mesh);

}  // namespace qchopper
