// Casts rays at a mesh.
//
// mm. RayTree and RayScene compute in single precision, about the centre of the mesh, so that the place of the mesh
// does not matter; the last bits of their answers follow the processor's instruction set, and the mesh need not be
// kept. PreciseRays decides in double precision and gives the same bits everywhere (tests/segment/mesh/rays_test.cpp).
// first_hit may be called from many threads at once.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

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
    // Whether there is one; faster.
    bool meets(Vec3 origin, Vec3 direction) const;
    // The same for many rays of one direction: 1 per origin whose ray meets a triangle, else 0. Faster the closer to
    // each other consecutive origins are. Both spans have the same size.
    void meets(std::span<const Vec3> origins, Vec3 direction, std::span<std::uint8_t> result) const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

// Several meshes, each moved by a shift of its own. Their trees are built once; moving them costs next to nothing.
// distances() may be called from many threads at once, place() from one.
class RayScene {
 public:
    static constexpr std::size_t max_rays = 8;

    // A tree per mesh, none moved. Meshes may be empty; they are not used afterwards.
    explicit RayScene(std::span<const TriangleMesh* const> meshes);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    // One shift (mm) per mesh.
    void place(std::span<const Vec3> shifts);
    // Per unit direction the distance from the origin to the first surface, or `far` where none is nearer. Both spans
    // have the same size, at most max_rays.
    void distances(Vec3 origin, std::span<const Vec3> directions, double far, std::span<float> result) const;

 private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

// Which rays of PreciseRays pass through which triangles. Default: none.
struct RayFilter {
    std::span<const std::uint32_t> label;  // one per triangle, or empty: none is passed through
    std::uint32_t wanted = 0;              // a ray meets only the triangles with this label
};

// First hits on several meshes, each asked on its own, in double precision. The tree only proposes triangles, by boxes
// that are wider than the rounding errors of single precision; whether and where a ray meets a triangle is decided from
// the corners. So an answer depends on neither the instruction set nor the shape of the tree, and a ray does not pass
// between two triangles with a common edge.
class PreciseRays {
 public:
    // `sse` takes the trees' code for SSE 4.2, for tests of this independence.
    enum class Instructions { widest, sse };
    // The meshes are not copied: they must outlive this.
    explicit PreciseRays(std::span<const TriangleMesh* const> meshes, Instructions instructions = Instructions::widest);
    ~PreciseRays();
    PreciseRays(PreciseRays&&) noexcept;
    PreciseRays& operator=(PreciseRays&&) noexcept;

    // The nearest triangle of mesh number `mesh` that the ray meets, from either side; of several at one distance that
    // with the lowest number. A triangle parallel to the ray is not met. Preconditions: the direction is a unit vector,
    // and the origin is no farther from the mesh's box than a tenth of its diagonal.
    std::optional<RayHit> first_hit(std::size_t mesh, Vec3 origin, Vec3 direction, const RayFilter& filter = {}) const;

 private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace qchopper
