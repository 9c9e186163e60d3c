// Sums over triangles, and a ray up from the middle of each. O(triangles) and O(triangles * log triangles), the rays in
// parallel; sums are taken in the order of the triangles, whatever the number of threads.

#include "cam/setup/undercut.h"

#include <atomic>
#include <cassert>
#include <vector>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// A vertical wall must not count as facing down because of rounding.
constexpr double wall = 1e-6;

constexpr std::size_t at_once = 1024;

// Calls use(i, is_occluded) for i of [0, count), on several threads:
// whether the triangle triangle_at(i) faces down or has a part of the mesh straight above its middle.
template <class TriangleAt, class Use>
void test_occlusion(const TriangleMesh& mesh, const RayTree& rays, Vec3 up, std::size_t count,
                    const TriangleAt& triangle_at, const Use& use) {
    const double off_the_surface = 1e-5 * norm(bounds(mesh).size());  // mm: rays are single precision
    parallel_ranges(0, count, at_once, [&](std::size_t first, std::size_t end) {
        std::vector<Vec3> origins;
        std::vector<std::size_t> of_origin;
        for (std::size_t i = first; i < end; ++i) {
            const std::size_t t = triangle_at(i);
            const Vec3 n = normalized(area_vector(mesh, t));
            if (dot(n, up) < -wall) {
                use(i, true);
                continue;
            }
            const Triangle& v = mesh.triangles[t];
            const Vec3 middle = (1.0 / 3) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
            origins.push_back(middle + off_the_surface * n);
            of_origin.push_back(i);
        }
        std::vector<std::uint8_t> is_below(origins.size());
        rays.meets(origins, up, is_below);
        for (std::size_t k = 0; k < origins.size(); ++k) use(of_origin[k], is_below[k] != 0);
    });
}

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
    std::vector<char> flags(mesh.triangles.size(), 0);
    test_occlusion(
        mesh, rays, up, flags.size(), [](std::size_t t) { return t; },
        [&](std::size_t t, bool is_occluded) { flags[t] = is_occluded ? 1 : 0; });
    double all = 0;
    double occluded = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (base && cap_of(mesh, t) == *base) continue;
        const double area = norm(area_vector(mesh, t));
        all += area;
        if (flags[t] != 0) occluded += area;
    }
    assert(occluded <= all);
    return all > 0 ? occluded / all : 0;
}

std::vector<std::uint32_t> area_sample(const TriangleMesh& mesh, std::size_t count) {
    assert(count > 0);
    double all = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) all += norm(area_vector(mesh, t));
    const double step = all / static_cast<double>(count);
    std::vector<std::uint32_t> sample;
    sample.reserve(count);
    double before = 0;
    for (std::size_t t = 0; t < mesh.triangles.size() && all > 0; ++t) {
        before += norm(area_vector(mesh, t));
        while (sample.size() < count && (static_cast<double>(sample.size()) + 0.5) * step <= before) {
            sample.push_back(static_cast<std::uint32_t>(t));
        }
    }
    return sample;
}

double occluded_area_ratio(const TriangleMesh& mesh, const RayTree& rays, Vec3 up,
                           std::span<const std::uint32_t> sample) {
    assert(!sample.empty());
    std::atomic<std::size_t> occluded = 0;
    test_occlusion(
        mesh, rays, up, sample.size(), [&](std::size_t i) { return sample[i]; },
        [&](std::size_t, bool is_occluded) { occluded += is_occluded ? 1 : 0; });
    return static_cast<double>(occluded) / static_cast<double>(sample.size());
}

}  // namespace qchopper
