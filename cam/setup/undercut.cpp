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

// Whether a triangle faces down or has a part of the mesh straight above its middle.
class OcclusionTest {
 public:
    OcclusionTest(const TriangleMesh& mesh, const RayTree& rays, Vec3 up)
        : mesh_(mesh), rays_(rays), up_(up), off_the_surface_(1e-5 * norm(bounds(mesh).size())) {}

    bool operator()(std::size_t triangle) const {
        const Vec3 n = normalized(area_vector(mesh_, triangle));
        if (dot(n, up_) < -wall) return true;
        const Triangle& v = mesh_.triangles[triangle];
        const Vec3 middle = (1.0 / 3) * (mesh_.points[v[0]] + mesh_.points[v[1]] + mesh_.points[v[2]]);
        return rays_.meets(middle + off_the_surface_ * n, up_);
    }

 private:
    const TriangleMesh& mesh_;
    const RayTree& rays_;
    Vec3 up_;
    double off_the_surface_;  // mm: rays are single precision
};

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
    const OcclusionTest is_occluded(mesh, rays, up);
    std::vector<char> flags(mesh.triangles.size(), 0);
    parallel_ranges(0, flags.size(), 1024, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) flags[t] = is_occluded(t) ? 1 : 0;
    });
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
    const OcclusionTest is_occluded(mesh, rays, up);
    std::atomic<std::size_t> occluded = 0;
    parallel_ranges(0, sample.size(), 1024, [&](std::size_t first, std::size_t end) {
        std::size_t found = 0;
        for (std::size_t i = first; i < end; ++i) found += is_occluded(sample[i]) ? 1 : 0;
        occluded += found;
    });
    return static_cast<double>(occluded) / static_cast<double>(sample.size());
}

}  // namespace qchopper
