// Normals of points are means over their triangles, weighted by area (Gouraud, "Continuous shading of curved surfaces",
// 1971); across edges sharper than 50 degrees the normal of the facet counts. O(points + triangles) once per mesh.

#include "segment/picture/scene.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr double crease = 0.64;  // cosine of 50 degrees

const TriangleMesh no_mesh;

std::vector<ColouredMesh> without_nulls(std::span<const ColouredMesh> meshes) {
    std::vector<ColouredMesh> all(meshes.begin(), meshes.end());
    for (ColouredMesh& one : all) {
        if (one.mesh == nullptr) one.mesh = &no_mesh;
    }
    return all;
}

std::vector<const TriangleMesh*> meshes_of(const std::vector<ColouredMesh>& all) {
    std::vector<const TriangleMesh*> meshes;
    meshes.reserve(all.size());
    for (const ColouredMesh& one : all) meshes.push_back(one.mesh);
    return meshes;
}

std::vector<Vec3> point_normals(const TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        const Vec3 weighted = area_vector(mesh, t);
        for (const std::uint32_t corner : mesh.triangles[t]) normals[corner] = normals[corner] + weighted;
    }
    for (Vec3& n : normals) n = normalized(n);
    return normals;
}

}  // namespace

Scene::Scene(std::span<const ColouredMesh> meshes, bool has_rays)
    : meshes_(without_nulls(meshes)), normals_(meshes_.size()) {
    if (has_rays) rays_.emplace(meshes_of(meshes_));
    first_triangle_.push_back(0);
    for (const ColouredMesh& one : meshes_)
        first_triangle_.push_back(first_triangle_.back() + one.mesh->triangles.size());
    parallel_for(0, meshes_.size(), [&](std::size_t i) { normals_[i] = point_normals(*meshes_[i].mesh); });
    update();
}

void Scene::place(std::span<const Vec3> shifts) {
    assert(shifts.size() == meshes_.size());
    for (std::size_t i = 0; i < meshes_.size(); ++i) meshes_[i].shift = shifts[i];
    update();
}

void Scene::update() {
    TriangleMesh corners;
    std::vector<Vec3> shifts;
    for (const ColouredMesh& one : meshes_) {
        shifts.push_back(one.shift);
        if (one.mesh->points.empty()) continue;
        const Box box = bounds(*one.mesh);
        corners.points.push_back(box.min + one.shift);
        corners.points.push_back(box.max + one.shift);
    }
    diagonal_ = norm(bounds(corners).size());
    if (rays_) rays_->place(shifts);
}

Region Scene::region_of(std::uint32_t triangle) const {
    const auto after = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), triangle);
    const auto mesh = static_cast<std::size_t>(after - first_triangle_.begin() - 1);
    return {static_cast<std::uint32_t>(mesh), cap_of(*meshes_[mesh].mesh, triangle - first_triangle_[mesh])};
}

SurfacePoint Scene::surface(std::uint32_t triangle, Vec3 at, Vec3 forward) const {
    SurfacePoint point;
    point.at = at;
    point.region = region_of(triangle);
    const ColouredMesh& one = meshes_[point.region.mesh];
    const std::size_t t = triangle - first_triangle_[point.region.mesh];
    assert(one.colour_of.empty() || (t < one.colour_of.size() && one.colour_of[t] < one.palette.size()));
    if (!one.colour_of.empty()) point.colour = one.colour_of[t];
    const Triangle& corner = one.mesh->triangles[t];
    const Vec3 p = at - one.shift;
    const std::array<Vec3, 3> to{one.mesh->points[corner[0]] - p, one.mesh->points[corner[1]] - p,
                                 one.mesh->points[corner[2]] - p};
    const Vec3 twice_area = cross(to[1] - to[0], to[2] - to[0]);
    const double length = norm(twice_area);
    if (length > 0) point.face_normal = (1 / length) * twice_area;
    point.normal = point.face_normal;
    if (point.region.cap == no_cap && length > 0) {
        Vec3 blended;
        for (std::size_t k = 0; k < 3; ++k) {
            const double share = dot(cross(to[(k + 1) % 3], to[(k + 2) % 3]), point.face_normal) / length;
            const Vec3 n = normals_[point.region.mesh][corner[k]];
            const bool is_smooth = dot(n, point.face_normal) >= crease;
            blended = blended + std::clamp(share, 0.0, 1.0) * (is_smooth ? n : point.face_normal);
        }
        point.normal = normalized(blended);
    }
    if (dot(point.face_normal, forward) > 0) {  // the inside of an open mesh
        point.face_normal = -point.face_normal;
        point.normal = -point.normal;
    }
    return point;
}

void Scene::distances(const SurfacePoint& point, std::span<const Vec3> directions, double far,
                      std::span<float> result) const {
    assert(rays_);
    // Rays are single precision.
    rays_->distances(point.at + (5e-5 * diagonal_) * point.face_normal, directions, far, result);
}

}  // namespace qchopper
