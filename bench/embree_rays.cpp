// The steps of Embree's own tutorials; see https://www.embree.org/api.html.

#include "bench/embree_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

namespace qchopper::bench {

namespace {

RTCRay embree_ray(const FreeRay& r) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(r.origin.x);
    ray.org_y = static_cast<float>(r.origin.y);
    ray.org_z = static_cast<float>(r.origin.z);
    ray.dir_x = static_cast<float>(r.direction.x);
    ray.dir_y = static_cast<float>(r.direction.y);
    ray.dir_z = static_cast<float>(r.direction.z);
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0U;
    return ray;
}

}  // namespace

struct EmbreeRays::Tree {
    RTCDevice device = rtcNewDevice("");
    RTCScene scene = rtcNewScene(device);
};

EmbreeRays::EmbreeRays(const TriangleMesh& mesh) : tree_(new Tree) {
    RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.points.size()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        points[3 * i] = static_cast<float>(mesh.points[i].x);
        points[3 * i + 1] = static_cast<float>(mesh.points[i].y);
        points[3 * i + 2] = static_cast<float>(mesh.points[i].z);
    }
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::copy_n(mesh.triangles[t].begin(), 3, corners + 3 * t);
    }
    rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(tree_->scene);
}

EmbreeRays::~EmbreeRays() {
    rtcReleaseScene(tree_->scene);
    rtcReleaseDevice(tree_->device);
    delete tree_;
}

std::vector<float> EmbreeRays::first_hits(std::span<const FreeRay> rays) const {
    std::vector<float> distances;
    distances.reserve(rays.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (const FreeRay& r : rays) {
        RTCRayHit hit{};
        hit.ray = embree_ray(r);
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(tree_->scene, &context, &hit);
        distances.push_back(hit.ray.tfar);
    }
    return distances;
}

bool EmbreeRays::is_free(const FreeRay& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay asked = embree_ray(ray);
    rtcOccluded1(tree_->scene, &context, &asked);
    return asked.tfar >= 0;  // a hit makes it negative
}

}  // namespace qchopper::bench
