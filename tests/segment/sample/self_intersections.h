// Counts the pairs of triangles that meet where they should not, exactly, by CGAL.

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace qchopper
