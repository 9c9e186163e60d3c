// Vertex normals, each triangle weighted by its angle at the vertex (Thürmer and Wüthrich 1998).

#pragma once

#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Unit vectors, one per point; zero where all triangles around are degenerate.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace qchopper
