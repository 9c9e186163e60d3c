// Closes one border loop with a refined and faired patch, which goes on as the surface around it bends.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Points inside the hole, and triangles that name them after the points of the mesh: the first new one has the number
// mesh.points.size().
struct FairPatch {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

// `loop` is one of border_loops (manifold.h). Nothing if no such patch is found, or one that swings out farther than
// the loop is wide.
std::optional<FairPatch> fair_hole(const TriangleMesh& mesh, std::span<const std::uint32_t> loop);

}  // namespace qchopper
