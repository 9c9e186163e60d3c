// Several coloured meshes as one that rays can ask: what is hit, which piece it is, how it is turned there.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/rays.h"
#include "segment/picture/coloured.h"

namespace qchopper {

// Where a ray meets the scene.
struct SeenPoint {
    Vec3 at;
    Vec3 face_normal;  // towards the eye
    Vec3 normal;       // the same, smooth across the facets of a round surface
    std::uint32_t triangle = 0;
};

class Scene {
 public:
    explicit Scene(std::span<const Coloured> meshes);

    std::optional<SeenPoint> look(Vec3 from, Vec3 direction) const;
    // Distance along the unit direction to what stands in the way; nothing: it is open.
    std::optional<double> blocked(const SeenPoint& point, Vec3 direction) const;

    const TriangleMesh& mesh() const { return mesh_; }
    std::uint32_t piece_of(std::uint32_t triangle) const { return piece_of_[triangle]; }
    Rgb colour(std::uint32_t triangle) const { return colours_[piece_of_[triangle]]; }
    double diagonal() const { return diagonal_; }

 private:
    static TriangleMesh join(std::span<const Coloured> meshes);
    Vec3 smooth_normal(std::uint32_t triangle, Vec3 at, Vec3 face_normal) const;

    TriangleMesh mesh_;
    std::vector<std::uint32_t> piece_of_;  // per triangle
    std::vector<Rgb> colours_;             // per piece
    std::vector<Vec3> normals_;            // per point, over its triangles that no cut made
    double diagonal_ = 0;
    RayTree rays_;
};

}  // namespace qchopper
