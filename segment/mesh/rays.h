// Rays against a mesh, by Embree.
//
// Rays are single precision inside; the tree is built around the mesh's own centre so that 3 m hold 0.001 mm.
// Safe to ask from many threads at once.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct RayHit {
    double distance = 0;  // along the direction, in its unit
    std::uint32_t triangle = 0;
};

class RayTree {
 public:
    explicit RayTree(const TriangleMesh& mesh);
    ~RayTree();
    RayTree(RayTree&&) noexcept;
    RayTree& operator=(RayTree&&) noexcept;

    // The first surface that the ray meets, from either side.
    std::optional<RayHit> first_hit(Vec3 origin, Vec3 direction) const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace qchopper
