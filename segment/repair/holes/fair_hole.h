// Closes one border loop with a refined and faired fill, which continues the curvature of the surface around it.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// New points, and triangles over the points of the mesh followed by these: the first new point has the number
// mesh.points.size().
struct FairFill {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

// `loop` is one of border_loops (manifold.h). Returns nothing if no fill is found, or one that reaches farther from the
// centre of the loop than three times the radius of the loop. The mesh stays as it is.
std::optional<FairFill> fair_hole(const TriangleMesh& mesh, std::span<const std::uint32_t> loop);

}  // namespace qchopper
