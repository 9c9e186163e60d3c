// Joins coloured meshes into one scene for rays: the point that is hit, its piece and its normals.
//
// Millimetres. Its const functions can be called from several threads at once.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/rays.h"
#include "segment/picture/coloured.h"

namespace qchopper {

// Where a ray meets the scene. The normals have length 1 and point towards the origin of the ray.
struct SurfaceHit {
    Vec3 at;
    Vec3 face_normal;
    Vec3 normal;  // blended over the triangle, so that a round surface appears smooth
    std::uint32_t triangle = 0;
};

// Preconditions of the functions that are given a triangle: it is an index of mesh().triangles.
class Scene {
 public:
    // Copies the meshes. Precondition: none is null.
    explicit Scene(std::span<const ColouredMesh> meshes);

    // The first point that the ray meets. Precondition: the direction has length 1.
    std::optional<SurfaceHit> cast_ray(Vec3 from, Vec3 direction) const;
    // The distance to the first surface in the unit direction from the point; nothing if there is none.
    std::optional<double> occluder_distance(const SurfaceHit& point, Vec3 direction) const;

    // All meshes; cap_of has one entry per triangle.
    const TriangleMesh& mesh() const { return mesh_; }
    // The index of the mesh that the triangle comes from.
    std::uint32_t piece_of(std::uint32_t triangle) const { return piece_of_[triangle]; }
    Rgb colour(std::uint32_t triangle) const { return colours_[piece_of_[triangle]]; }
    double diagonal() const { return diagonal_; }

 private:
    static TriangleMesh join(std::span<const ColouredMesh> meshes);
    Vec3 smooth_normal(std::uint32_t triangle, Vec3 at, Vec3 face_normal) const;

    TriangleMesh mesh_;
    std::vector<std::uint32_t> piece_of_;  // per triangle
    std::vector<Rgb> colours_;             // per piece
    std::vector<Vec3> normals_;            // per point, over its triangles that are no caps
    double diagonal_ = 0;                  // of the box around all
    RayTree rays_;
};

}  // namespace qchopper
