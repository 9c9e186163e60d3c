// The bounding rectangle of all points across the view direction, scaled to the picture less its border. O(points).

#include "segment/picture/camera.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "base/parallel.h"

namespace qchopper {
namespace {

constexpr double most = std::numeric_limits<double>::max();

// The box of the points in the coordinates right, up, forward.
struct ViewBox {
    Vec3 low{most, most, most};
    Vec3 high{-most, -most, -most};
    void add(Vec3 p) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    }
};

ViewBox view_box(std::span<const ColouredMesh> meshes, const Camera& camera) {
    ViewBox all;
    std::mutex mutex;
    for (const ColouredMesh& one : meshes) {
        parallel_ranges(0, one.mesh->points.size(), 1 << 14, [&](std::size_t first, std::size_t end) {
            ViewBox box;
            for (std::size_t i = first; i < end; ++i) {
                const Vec3 p = one.mesh->points[i] + one.shift;
                box.add({dot(camera.right, p), dot(camera.up, p), dot(camera.forward, p)});
            }
            const std::lock_guard lock(mutex);  // minima and maxima do not depend on the order
            all.add(box.low);
            all.add(box.high);
        });
    }
    return all;
}

}  // namespace

Camera framed(std::span<const ColouredMesh> meshes, const PictureOptions& options) {
    Camera camera;
    camera.forward = normalized(options.view);
    camera.right = cross(camera.forward, options.up);
    if (norm(camera.right) < 1e-9) camera.right = cross(camera.forward, Vec3{0, 1, 0});  // straight from above
    if (norm(camera.right) < 1e-9) camera.right = Vec3{1, 0, 0};
    camera.right = normalized(camera.right);
    camera.up = cross(camera.right, camera.forward);
    const ViewBox box = view_box(meshes, camera);
    if (box.low.x > box.high.x) return camera;
    const Vec3 size = box.high - box.low;
    const double inner = 1 - 2 * options.frame;
    camera.mm_per_pixel = std::max(size.x / (options.width * inner), size.y / (options.height * inner));
    if (!(camera.mm_per_pixel > 0)) camera.mm_per_pixel = 1;
    const Vec3 middle = 0.5 * (box.low + box.high);
    const double before = box.low.z - 0.05 * norm(size) - 1;
    camera.origin = middle.x * camera.right + middle.y * camera.up + before * camera.forward;
    return camera;
}

}  // namespace qchopper
