// Sums over triangles, and a ray up from the middle of each. O(triangles) and O(triangles * log triangles), the rays in
// parallel; sums are taken in the order of the triangles, whatever the number of threads.

#include "cam/setup/undercut.h"

#include <cassert>
#include <vector>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// A vertical wall must not count as facing down because of rounding.
constexpr double wall = 1e-6;

}  // namespace

Facing facing(const TriangleMesh& mesh, Vec3 up, std::optional<std::int32_t> base) {
    assert(is_consistent(mesh) && norm(up) > 0);
    Facing sums;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double projected = dot(area_vector(mesh, t), up);
        if (base && cap_of(mesh, t) == *base) {
            sums.base -= projected;
            ++sums.base_triangles;
        } else if (projected < 0) {
            sums.down -= projected;
        } else {
            sums.up += projected;
        }
    }
    return sums;
}

double occluded_area_ratio(const TriangleMesh& mesh, const RayTree& rays, Vec3 up, std::optional<std::int32_t> base) {
    const double off_the_surface = 1e-5 * norm(bounds(mesh).size());  // rays are single precision
    std::vector<char> is_occluded(mesh.triangles.size(), 0);
    const auto cast_rays = [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            const Vec3 n = normalized(area_vector(mesh, t));
            if (dot(n, up) < -wall) {
                is_occluded[t] = 1;
                continue;
            }
            const Triangle& corner = mesh.triangles[t];
            const Vec3 middle = (1.0 / 3) * (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]);
            is_occluded[t] = rays.first_hit(middle + off_the_surface * n, up).has_value() ? 1 : 0;
        }
    };
    parallel_ranges(0, mesh.triangles.size(), 1024, cast_rays);
    double all = 0;
    double occluded = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (base && cap_of(mesh, t) == *base) continue;
        const double area = norm(area_vector(mesh, t));
        all += area;
        if (is_occluded[t] != 0) occluded += area;
    }
    assert(occluded <= all);
    return all > 0 ? occluded / all : 0;
}

}  // namespace qchopper
