// Counts the pairs of triangles that intersect, exactly, by CGAL. A triangle that CGAL refuses counts as well.

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace qchopper
