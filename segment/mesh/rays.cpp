// By Embree: I. Wald, S. Woop, C. Benthin, G. Johnson and M. Ernst, "Embree: a kernel framework for efficient CPU ray
// tracing" (2014). O(log triangles) per ray on average; moving a mesh of a RayScene is O(meshes).

#include "segment/mesh/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <vector>

#include "segment/mesh/measure.h"

// The number of threads for Embree: all, but one under the thread sanitizer, which does not follow those of TBB.
#ifndef QCHOPPER_EMBREE_CONFIG
#define QCHOPPER_EMBREE_CONFIG nullptr
#endif

namespace qchopper {
namespace {

// Embree counts references to its handles.
struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

Device new_device() {
    return Device(rtcNewDevice(QCHOPPER_EMBREE_CONFIG));
}

EmbreeScene new_scene(const Device& device) {
    EmbreeScene scene(rtcNewScene(device.get()));
    // Low quality: built in 0.29 s instead of 1.1 s at 1.9 million faces, and rays are a fifth slower.
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
    return scene;
}

// Points count from `centre`.
EmbreeScene scene_of(const Device& device, const TriangleMesh& mesh, Vec3 centre) {
    EmbreeScene scene = new_scene(device);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.points.size()));
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        const Vec3 at = mesh.points[p] - centre;
        vertex[3 * p] = static_cast<float>(at.x);
        vertex[3 * p + 1] = static_cast<float>(at.y);
        vertex[3 * p + 2] = static_cast<float>(at.z);
    }
    auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) index[3 * t + k] = mesh.triangles[t][k];
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

}  // namespace

struct RayTree::Tree {
    Device device = new_device();
    EmbreeScene scene;
    Vec3 centre;
};

RayTree::RayTree(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
    assert(is_consistent(mesh));
    tree_->centre = bounds(mesh).centre();
    tree_->scene = scene_of(tree_->device, mesh, tree_->centre);
}

RayTree::~RayTree() = default;
RayTree::RayTree(RayTree&&) noexcept = default;
RayTree& RayTree::operator=(RayTree&&) noexcept = default;

namespace {

RTCRay ray_from(Vec3 from, Vec3 direction) {
    assert(norm(direction) > 0);
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0U;
    return ray;
}

}  // namespace

std::optional<RayHit> RayTree::first_hit(Vec3 origin, Vec3 direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{ray_from(origin - tree_->centre, direction), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree_->scene.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{static_cast<double>(ray.ray.tfar), ray.hit.primID};
}

bool RayTree::meets(Vec3 origin, Vec3 direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_from(origin - tree_->centre, direction);
    rtcOccluded1(tree_->scene.get(), &context, &ray);
    return ray.tfar < 0;  // Embree's answer: minus infinity
}

struct RayScene::Trees {
    Device device = new_device();
    std::vector<EmbreeScene> of_mesh;  // about the mesh's centre; null for an empty one
    std::vector<Vec3> mesh_centre;
    EmbreeScene all;  // instances of the trees, about `centre`
    Vec3 centre;
};

RayScene::RayScene(std::span<const TriangleMesh* const> meshes) : trees_(std::make_unique<Trees>()) {
    for (const TriangleMesh* mesh : meshes) {
        assert(is_consistent(*mesh));
        trees_->mesh_centre.push_back(mesh->points.empty() ? Vec3{} : bounds(*mesh).centre());
        trees_->of_mesh.push_back(
            mesh->triangles.empty() ? nullptr : scene_of(trees_->device, *mesh, trees_->mesh_centre.back()));
    }
    place(std::vector<Vec3>(meshes.size()));
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::place(std::span<const Vec3> shifts) {
    Trees& trees = *trees_;
    assert(shifts.size() == trees.of_mesh.size());
    trees.all = new_scene(trees.device);
    trees.centre = {};
    for (std::size_t i = 0; i < shifts.size(); ++i) {
        trees.centre = trees.centre + (1.0 / static_cast<double>(shifts.size())) * (trees.mesh_centre[i] + shifts[i]);
    }
    for (std::size_t i = 0; i < shifts.size(); ++i) {
        if (!trees.of_mesh[i]) continue;
        RTCGeometry instance = rtcNewGeometry(trees.device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, trees.of_mesh[i].get());
        const Vec3 to = trees.mesh_centre[i] + shifts[i] - trees.centre;
        const std::array<float, 12> columns{
            1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)};
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
        rtcCommitGeometry(instance);
        rtcAttachGeometry(trees.all.get(), instance);
        rtcReleaseGeometry(instance);
    }
    rtcCommitScene(trees.all.get());
}

void RayScene::distances(Vec3 origin, std::span<const Vec3> directions, double far, std::span<float> result) const {
    assert(directions.size() == result.size() && directions.size() <= most_rays);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const Vec3 from = origin - trees_->centre;
    alignas(32) RTCRayHit8 rays{};
    alignas(32) std::array<int, most_rays> is_valid{};
    for (std::size_t i = 0; i < directions.size(); ++i) {
        is_valid[i] = -1;
        rays.ray.org_x[i] = static_cast<float>(from.x);
        rays.ray.org_y[i] = static_cast<float>(from.y);
        rays.ray.org_z[i] = static_cast<float>(from.z);
        rays.ray.dir_x[i] = static_cast<float>(directions[i].x);
        rays.ray.dir_y[i] = static_cast<float>(directions[i].y);
        rays.ray.dir_z[i] = static_cast<float>(directions[i].z);
        rays.ray.tfar[i] = static_cast<float>(far);
        rays.ray.mask[i] = ~0U;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(is_valid.data(), trees_->all.get(), &context, &rays);
    std::copy_n(std::begin(rays.ray.tfar), result.size(), result.begin());
}

}  // namespace qchopper
