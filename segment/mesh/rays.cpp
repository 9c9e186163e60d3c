// By Embree: I. Wald, S. Woop, C. Benthin, G. Johnson and M. Ernst, "Embree: a kernel framework for efficient CPU ray
// tracing" (2014). O(log triangles) per ray on average; moving a mesh of a RayScene is O(meshes).
//
// PreciseRays: the triangles are user geometry of Embree, whose boxes are widened by 1e-6 of the mesh's diagonal, more
// than the rounding of a ray to single precision moves it within the box; a triangle is tested by the signs of the
// three volumes of the ray with its edges, which are opposite to the last bit for the two triangles at an edge: S.
// Woop, C. Benthin and I. Wald, "Watertight ray/triangle intersection" (2013).

#include "segment/mesh/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "segment/mesh/measure.h"

// The number of threads for Embree: all, but one under the thread sanitizer, which does not follow those of TBB.
#ifndef QCHOPPER_EMBREE_CONFIG
#define QCHOPPER_EMBREE_CONFIG ""
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

constexpr std::size_t triangles_at_once = 1 << 21;

EmbreeScene new_scene(const Device& device) {
    EmbreeScene scene(rtcNewScene(device.get()));
    // Low quality: built in 0.29 s instead of 1.1 s at 1.9 million faces, and rays are a fifth slower.
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
    return scene;
}

// Attaches a shared buffer of a mesh's points, counted from `centre`, and the triangles [first, last).
void attach(const Device& device, RTCBuffer points, std::size_t point_count, const TriangleMesh& mesh,
            std::size_t first, std::size_t last, RTCScene scene) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, points, 0, 3 * sizeof(float),
                         point_count);
    auto* index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), last - first));
    for (std::size_t t = first; t < last; ++t) std::copy_n(mesh.triangles[t].begin(), 3, index + 3 * (t - first));
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

// Points count from `centre`.
RTCBuffer new_points(const Device& device, const TriangleMesh& mesh, Vec3 centre) {
    RTCBuffer buffer = rtcNewBuffer(device.get(), (3 * mesh.points.size() + 1) * sizeof(float));
    auto* at = static_cast<float*>(rtcGetBufferData(buffer));
    for (const Vec3& p : mesh.points) {
        const Vec3 d = p - centre;
        *at++ = static_cast<float>(d.x);
        *at++ = static_cast<float>(d.y);
        *at++ = static_cast<float>(d.z);
    }
    return buffer;
}

void attach_instance(const Device& device, RTCScene of, Vec3 at, RTCScene scene) {
    RTCGeometry instance = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, of);
    const std::array<float, 12> columns{
        1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometry(scene, instance);
    rtcReleaseGeometry(instance);
}

// Scenes of at most triangles_at_once consecutive triangles each. Building a tree takes several times the memory of the
// finished one, so that the memory at the peak follows the largest tree.
std::vector<EmbreeScene> scenes_of(const Device& device, const TriangleMesh& mesh, Vec3 centre) {
    RTCBuffer points = new_points(device, mesh, centre);
    std::vector<EmbreeScene> scenes;
    for (std::size_t first = 0; first < mesh.triangles.size(); first += triangles_at_once) {
        EmbreeScene& scene = scenes.emplace_back(new_scene(device));
        const std::size_t last = std::min(mesh.triangles.size(), first + triangles_at_once);
        attach(device, points, mesh.points.size(), mesh, first, last, scene.get());
        rtcCommitScene(scene.get());
    }
    rtcReleaseBuffer(points);
    return scenes;
}

}  // namespace

struct RayTree::Tree {
    Device device = new_device();
    std::vector<EmbreeScene> parts;
    EmbreeScene all;  // instances of the parts; null if there is only one
    Vec3 centre;
    RTCScene scene() const { return all ? all.get() : parts.front().get(); }
};

RayTree::RayTree(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
    assert(is_consistent(mesh));
    tree_->centre = bounds(mesh).centre();
    tree_->parts = scenes_of(tree_->device, mesh, tree_->centre);
    if (tree_->parts.size() == 1) return;
    tree_->all = new_scene(tree_->device);
    for (const EmbreeScene& part : tree_->parts) attach_instance(tree_->device, part.get(), {}, tree_->all.get());
    rtcCommitScene(tree_->all.get());
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
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree_->scene(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const std::size_t part = tree_->all ? ray.hit.instID[0] : 0;
    return RayHit{static_cast<double>(ray.ray.tfar),
                  static_cast<std::uint32_t>(part * triangles_at_once + ray.hit.primID)};
}

bool RayTree::meets(Vec3 origin, Vec3 direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_from(origin - tree_->centre, direction);
    rtcOccluded1(tree_->scene(), &context, &ray);
    return ray.tfar < 0;  // Embree's answer: minus infinity
}

void RayTree::meets(std::span<const Vec3> origins, Vec3 direction, std::span<std::uint8_t> result) const {
    assert(origins.size() == result.size());
    constexpr std::size_t width = 8;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < origins.size(); first += width) {
        const std::size_t count = std::min(width, origins.size() - first);
        alignas(32) RTCRay8 rays{};
        alignas(32) std::array<int, width> is_valid{};
        for (std::size_t i = 0; i < count; ++i) {
            const RTCRay ray = ray_from(origins[first + i] - tree_->centre, direction);
            is_valid[i] = -1;
            rays.org_x[i] = ray.org_x;
            rays.org_y[i] = ray.org_y;
            rays.org_z[i] = ray.org_z;
            rays.dir_x[i] = ray.dir_x;
            rays.dir_y[i] = ray.dir_y;
            rays.dir_z[i] = ray.dir_z;
            rays.tfar[i] = ray.tfar;
            rays.mask[i] = ray.mask;
        }
        rtcOccluded8(is_valid.data(), tree_->scene(), &context, &rays);
        for (std::size_t i = 0; i < count; ++i) result[first + i] = rays.tfar[i] < 0 ? 1 : 0;
    }
}

struct RayScene::Trees {
    Device device = new_device();
    std::vector<std::vector<EmbreeScene>> of_mesh;  // about the mesh's centre; none for an empty one
    std::vector<Vec3> mesh_centre;
    EmbreeScene all;  // instances of the trees, about `centre`
    Vec3 centre;
};

RayScene::RayScene(std::span<const TriangleMesh* const> meshes) : trees_(std::make_unique<Trees>()) {
    for (const TriangleMesh* mesh : meshes) {
        assert(is_consistent(*mesh));
        trees_->mesh_centre.push_back(mesh->points.empty() ? Vec3{} : bounds(*mesh).centre());
        trees_->of_mesh.push_back(scenes_of(trees_->device, *mesh, trees_->mesh_centre.back()));
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
        const Vec3 at = trees.mesh_centre[i] + shifts[i] - trees.centre;
        for (const EmbreeScene& part : trees.of_mesh[i]) {
            attach_instance(trees.device, part.get(), at, trees.all.get());
        }
    }
    rtcCommitScene(trees.all.get());
}

void RayScene::distances(Vec3 origin, std::span<const Vec3> directions, double far, std::span<float> result) const {
    assert(directions.size() == result.size() && directions.size() <= max_rays);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const Vec3 from = origin - trees_->centre;
    alignas(32) RTCRayHit8 rays{};
    alignas(32) std::array<int, max_rays> is_valid{};
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

namespace {

// The axes of space with that along which a ray is longest last, and the shear that turns the ray to it.
struct RayShear {
    explicit RayShear(Vec3 direction) {
        const Vec3 size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
        if (size.x >= size.y && size.x >= size.z) {
            u = &Vec3::y;
            v = &Vec3::z;
            w = &Vec3::x;
        } else if (size.y >= size.z) {
            u = &Vec3::z;
            v = &Vec3::x;
            w = &Vec3::y;
        }
        scale = 1 / (direction.*w);
        along_u = scale * (direction.*u);
        along_v = scale * (direction.*v);
    }
    double Vec3::*u = &Vec3::x;
    double Vec3::*v = &Vec3::y;
    double Vec3::*w = &Vec3::z;
    double along_u = 0;
    double along_v = 0;
    double scale = 0;
};

// The distance from the origin, along the ray with this shear, to a triangle whose corners count from it, or a negative
// number.
double distance_to(Vec3 a, Vec3 b, Vec3 c, const RayShear& shear) {
    const auto u = [&](const Vec3& p) { return p.*shear.u - shear.along_u * (p.*shear.w); };
    const auto v = [&](const Vec3& p) { return p.*shear.v - shear.along_v * (p.*shear.w); };
    const double au = u(a);
    const double av = v(a);
    const double bu = u(b);
    const double bv = v(b);
    const double cu = u(c);
    const double cv = v(c);
    const double of_a = cu * bv - cv * bu;
    const double of_b = au * cv - av * cu;
    if ((of_a < 0 && of_b > 0) || (of_a > 0 && of_b < 0)) return -1;
    const double of_c = bu * av - bv * au;
    if ((of_a < 0 || of_b < 0) ? of_c > 0 : (of_a > 0 || of_b > 0) && of_c < 0) return -1;
    const double sum = of_a + of_b + of_c;
    if (sum == 0) return -1;
    return shear.scale * (of_a * (a.*shear.w) + of_b * (b.*shear.w) + of_c * (c.*shear.w)) / sum;
}

// A ray of PreciseRays on its way through the tree.
struct PreciseRay {
    RTCIntersectContext context;  // first: Embree hands its address back
    Vec3 origin;
    RayShear shear;
    RayFilter filter;
    double slack = 0;  // mm: what the tree may be wrong by
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
};

// The triangles [first, first + triangles_at_once) of a mesh.
struct TriangleRun {
    const TriangleMesh* mesh = nullptr;
    std::size_t first = 0;
    Vec3 centre;
    double slack = 0;  // mm
};

void run_bounds(const RTCBoundsFunctionArguments* args) {
    const auto& run = *static_cast<const TriangleRun*>(args->geometryUserPtr);
    const auto [a, b, c] = corners_of(*run.mesh, run.first + args->primID);
    const auto low = [&](double u, double v, double w, double centre) {
        return static_cast<float>(std::min({u, v, w}) - centre - run.slack);
    };
    const auto high = [&](double u, double v, double w, double centre) {
        return static_cast<float>(std::max({u, v, w}) - centre + run.slack);
    };
    args->bounds_o->lower_x = low(a.x, b.x, c.x, run.centre.x);
    args->bounds_o->lower_y = low(a.y, b.y, c.y, run.centre.y);
    args->bounds_o->lower_z = low(a.z, b.z, c.z, run.centre.z);
    args->bounds_o->upper_x = high(a.x, b.x, c.x, run.centre.x);
    args->bounds_o->upper_y = high(a.y, b.y, c.y, run.centre.y);
    args->bounds_o->upper_z = high(a.z, b.z, c.z, run.centre.z);
}

void meet_run(const RTCIntersectFunctionNArguments* args) {
    assert(args->N == 1);
    if (args->valid[0] == 0) return;
    const auto& run = *static_cast<const TriangleRun*>(args->geometryUserPtr);
    auto& precise = *reinterpret_cast<PreciseRay*>(args->context);
    const std::size_t t = run.first + args->primID;
    if (!precise.filter.label.empty() && precise.filter.label[t] != precise.filter.wanted) return;
    const auto [a, b, c] = corners_of(*run.mesh, t);
    const double distance = distance_to(a - precise.origin, b - precise.origin, c - precise.origin, precise.shear);
    if (distance < 0 || distance > precise.distance || (distance == precise.distance && t > precise.triangle)) return;
    precise.distance = distance;
    precise.triangle = static_cast<std::uint32_t>(t);
    // What is as near within the slack is tested as well.
    reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = static_cast<float>(distance + 2 * precise.slack);
}

}  // namespace

struct PreciseRays::Trees {
    explicit Trees(Instructions instructions)
        : device(instructions == Instructions::sse ? Device(rtcNewDevice("isa=sse4.2," QCHOPPER_EMBREE_CONFIG))
                                                   : new_device()) {}
    struct Mesh {
        std::vector<std::unique_ptr<TriangleRun>> runs;  // their addresses are Embree's
        std::vector<EmbreeScene> scenes;                 // one per run
        Vec3 centre;
        double slack = 0;
    };
    Device device;
    std::vector<Mesh> meshes;
};

PreciseRays::PreciseRays(std::span<const TriangleMesh* const> meshes, Instructions instructions)
    : trees_(std::make_unique<Trees>(instructions)) {
    for (const TriangleMesh* mesh : meshes) {
        assert(is_consistent(*mesh));
        Trees::Mesh& tree = trees_->meshes.emplace_back();
        const Box box = bounds(*mesh);
        tree.centre = box.centre();
        tree.slack = 1e-6 * norm(box.size());
        for (std::size_t first = 0; first < mesh->triangles.size(); first += triangles_at_once) {
            tree.runs.push_back(std::make_unique<TriangleRun>(TriangleRun{mesh, first, tree.centre, tree.slack}));
            RTCGeometry geometry = rtcNewGeometry(trees_->device.get(), RTC_GEOMETRY_TYPE_USER);
            rtcSetGeometryUserPrimitiveCount(
                geometry, static_cast<unsigned>(std::min(mesh->triangles.size() - first, triangles_at_once)));
            rtcSetGeometryUserData(geometry, tree.runs.back().get());
            rtcSetGeometryBoundsFunction(geometry, run_bounds, nullptr);
            rtcSetGeometryIntersectFunction(geometry, meet_run);
            rtcCommitGeometry(geometry);
            EmbreeScene& scene = tree.scenes.emplace_back(rtcNewScene(trees_->device.get()));
            rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
            rtcAttachGeometry(scene.get(), geometry);
            rtcReleaseGeometry(geometry);
            rtcCommitScene(scene.get());
        }
    }
}

PreciseRays::~PreciseRays() = default;
PreciseRays::PreciseRays(PreciseRays&&) noexcept = default;
PreciseRays& PreciseRays::operator=(PreciseRays&&) noexcept = default;

std::optional<RayHit> PreciseRays::first_hit(std::size_t mesh, Vec3 origin, Vec3 direction,
                                             const RayFilter& filter) const {
    assert(mesh < trees_->meshes.size());
    assert(std::abs(norm(direction) - 1) < 1e-6);
    const Trees::Mesh& tree = trees_->meshes[mesh];
    PreciseRay precise{{}, origin, RayShear(direction), filter, tree.slack};
    rtcInitIntersectContext(&precise.context);
    RTCRayHit ray{ray_from(origin - tree.centre, direction), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    for (const EmbreeScene& scene : tree.scenes) rtcIntersect1(scene.get(), &precise.context, &ray);
    if (precise.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
    return RayHit{precise.distance, precise.triangle};
}

}  // namespace qchopper
