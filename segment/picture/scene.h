// Several coloured meshes at their places: the normals of their surfaces, and distances along rays.
//
// Normals and ray trees are computed once per mesh and serve however the meshes are moved afterwards.

#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/rays.h"
#include "segment/picture/camera.h"

namespace qchopper {

// A mesh and one of its caps, or the rest of its surface.
struct Region {
    static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t mesh = background;
    std::int32_t cap = no_cap;
    bool operator==(const Region&) const = default;
};

struct SurfacePoint {
    Vec3 at;
    Vec3 face_normal;  // towards the camera
    Vec3 normal;       // the same, smooth across the facets of a round surface
    Region region;
    std::uint8_t colour = 0;  // index in the palette of the mesh; 0 without one
};

class Scene {
 public:
    // Entries whose mesh is null count as empty. The meshes stay the caller's and must outlive the scene. Without rays
    // there is no ambient light (PictureOptions::ambient_rays must be 0), and the trees are not built.
    explicit Scene(std::span<const ColouredMesh> meshes, bool has_rays = true);

    // Moves the meshes: one shift (mm) each, in place of those that they came with.
    void place(std::span<const Vec3> shifts);

    std::span<const ColouredMesh> meshes() const { return meshes_; }
    // What a triangle belongs to, counted through all meshes in their order.
    Region region_of(std::uint32_t triangle) const;
    // The surface at a point of a triangle, seen along the unit vector `forward`.
    SurfacePoint surface(std::uint32_t triangle, Vec3 at, Vec3 forward) const;
    // Distances along unit directions from just above the surface to the next one; `far` where none is nearer. Sizes
    // are equal, at most RayScene::max_rays. Precondition: has_rays().
    void distances(const SurfacePoint& point, std::span<const Vec3> directions, double far,
                   std::span<float> result) const;
    bool has_rays() const { return rays_.has_value(); }
    double diagonal() const { return diagonal_; }  // of the box of all meshes at their places

 private:
    void update();

    std::vector<ColouredMesh> meshes_;
    std::vector<std::size_t> first_triangle_;  // per mesh, and one more: the number of all triangles
    std::vector<std::vector<Vec3>> normals_;   // per mesh and point, over the triangles that no cut made
    std::optional<RayScene> rays_;
    double diagonal_ = 0;
};

}  // namespace qchopper
