// Embree finds what a ray meets; normals of points are blended over a triangle by Bui Tuong Phong, "Illumination for
// Computer Generated Pictures", 1975, but not across sharp edges. Building: as Embree's tree, O(n log n) in triangles.

#include "segment/picture/scene.h"

#include <algorithm>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr double crease = 0.64;  // cosine of 50 degrees; sharper edges are not smoothed

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

TriangleMesh Scene::join(std::span<const ColouredMesh> meshes) {
    TriangleMesh all;
    for (const ColouredMesh& one : meshes) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        for (const Vec3& p : one.mesh->points) all.points.push_back(p + one.shift);
        for (std::size_t t = 0; t < one.mesh->triangles.size(); ++t) {
            const Triangle& corner = one.mesh->triangles[t];
            all.triangles.push_back({first + corner[0], first + corner[1], first + corner[2]});
            all.cap_of.push_back(qchopper::cap_of(*one.mesh, t));
        }
    }
    return all;
}

Scene::Scene(std::span<const ColouredMesh> meshes)
    : mesh_(join(meshes)), normals_(point_normals(mesh_)), diagonal_(norm(bounds(mesh_).size())), rays_(mesh_) {
    for (const ColouredMesh& one : meshes) {
        piece_of_.insert(piece_of_.end(), one.mesh->triangles.size(), static_cast<std::uint32_t>(colours_.size()));
        colours_.push_back(one.colour);
    }
}

Vec3 Scene::smooth_normal(std::uint32_t triangle, Vec3 at, Vec3 face_normal) const {
    if (mesh_.cap_of[triangle] != no_cap) return face_normal;
    const Triangle& corner = mesh_.triangles[triangle];
    const double twice_area = dot(2.0 * area_vector(mesh_, triangle), face_normal);
    if (!(twice_area > 0)) return face_normal;
    Vec3 blended;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 b = mesh_.points[corner[(k + 1) % 3]];
        const Vec3 c = mesh_.points[corner[(k + 2) % 3]];
        const double weight = std::clamp(dot(cross(b - at, c - at), face_normal) / twice_area, 0.0, 1.0);
        const Vec3 n = normals_[corner[k]];
        blended = blended + weight * (dot(n, face_normal) >= crease ? n : face_normal);
    }
    return normalized(blended);
}

std::optional<SurfaceHit> Scene::cast_ray(Vec3 from, Vec3 direction) const {
    const std::optional<RayHit> hit = rays_.first_hit(from, direction);
    if (!hit) return std::nullopt;
    SurfaceHit point;
    point.triangle = hit->triangle;
    point.at = from + hit->distance * direction;
    point.face_normal = normalized(area_vector(mesh_, hit->triangle));
    point.normal = smooth_normal(hit->triangle, point.at, point.face_normal);
    if (dot(point.face_normal, direction) > 0) {  // the inside of an open mesh
        point.face_normal = -point.face_normal;
        point.normal = -point.normal;
    }
    return point;
}

std::optional<double> Scene::occluder_distance(const SurfaceHit& point, Vec3 direction) const {
    const Vec3 above = point.at + (5e-5 * diagonal_) * point.face_normal;  // rays have single precision
    const std::optional<RayHit> hit = rays_.first_hit(above, direction);
    return hit ? std::optional<double>(hit->distance) : std::nullopt;
}

}  // namespace qchopper
