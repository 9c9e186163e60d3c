// Vertex normals: the normals of the triangles around, each weighted by its angle at the vertex.

#pragma once

#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Unit vectors, one per point; zero where there is no triangle around, or all are degenerate.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace qchopper
