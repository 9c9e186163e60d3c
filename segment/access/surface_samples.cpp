// Two passes over the triangles: the sum of the areas, then the same sum again while samples are taken from it.

#include "segment/access/surface_samples.h"

#include <cassert>
#include <cmath>
#include <random>

namespace qchopper {
namespace {

constexpr std::uint64_t seed = 20'000;

// In [0, 1). std::uniform_real_distribution differs between libraries.
double random_share(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Calls use(surface, triangle, area vector, area) for the triangles that may carry samples.
template <class Use>
void for_carrying_triangles(std::span<const SampledSurface> surfaces, const Use& use) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto& [mesh, is_left_out] = surfaces[s];
        assert(is_left_out.empty() || is_left_out.size() == mesh->triangles.size());
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            if (!is_left_out.empty() && is_left_out[t]) continue;
            const Vec3 vector = area_vector(*mesh, t);
            const double area = norm(vector);
            if (area > 0) use(s, t, vector, area);
        }
    }
}

Vec3 random_point(const std::array<Vec3, 3>& corners, std::mt19937_64& random) {
    const double root = std::sqrt(random_share(random));
    const double along = random_share(random);
    return (1 - root) * corners[0] + (root * (1 - along)) * corners[1] + (root * along) * corners[2];
}

}  // namespace

SurfaceSamples surface_samples(std::span<const SampledSurface> surfaces, std::size_t count) {
    assert(count > 0);
    SurfaceSamples result;
    double all = 0;
    std::size_t last_surface = 0;
    std::size_t last_triangle = 0;
    for_carrying_triangles(surfaces, [&](std::size_t s, std::size_t t, Vec3, double area) {
        all += area;
        last_surface = s;
        last_triangle = t;
    });
    if (all == 0) return result;
    result.area_each_mm2 = all / static_cast<double>(count);
    result.sample.reserve(count);
    std::mt19937_64 random(seed);
    double before = 0;
    double next = random_share(random) * result.area_each_mm2;
    for_carrying_triangles(surfaces, [&](std::size_t s, std::size_t t, Vec3 vector, double area) {
        before += area;
        // The last triangle takes what rounding leaves over.
        const bool is_last = s == last_surface && t == last_triangle;
        while (result.sample.size() < count && (next < before || is_last)) {
            result.sample.push_back({random_point(corners_of(*surfaces[s].mesh, t), random), (1 / area) * vector,
                                     static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(t)});
            next = (static_cast<double>(result.sample.size()) + random_share(random)) * result.area_each_mm2;
        }
    });
    assert(result.sample.size() == count);
    return result;
}

}  // namespace qchopper
