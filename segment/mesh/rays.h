// Casts rays at a mesh.
//
// mm. Rays are computed in single precision, about the centre of the mesh, so that the place of the mesh does not
// matter (tests/segment/mesh/rays_test.cpp). first_hit may be called from many threads at once. The mesh need not be
// kept.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct RayHit {
    double distance = 0;  // in lengths of the direction
    std::uint32_t triangle = 0;
};

class RayTree {
 public:
    explicit RayTree(const TriangleMesh& mesh);
    ~RayTree();
    RayTree(RayTree&&) noexcept;
    RayTree& operator=(RayTree&&) noexcept;

    // The first triangle that the ray meets, from either side; nothing if there is none. Precondition: the direction is
    // not zero.
    std::optional<RayHit> first_hit(Vec3 origin, Vec3 direction) const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace qchopper
