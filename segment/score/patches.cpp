#include "segment/score/patches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/huge_pages.h"
#include "segment/mesh/order.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Where runs of triangles begin. A run goes on while the next triangle shares a point with it and there is room.
void divide(Patches& patches, const TriangleMesh& mesh) {
    auto last = huge(mesh.points.size(), none);  // the patch that had a point last
    reserve_huge(patches.neighbour, mesh.points.size());
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) patches.neighbour.push_back({v, v});
    reserve_huge(patches.patch, mesh.triangles.size() / (triangles_per_patch / 2));
    reserve_huge(patches.point, mesh.triangles.size() + mesh.triangles.size() / 8);
    std::uint32_t p = none;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const bool goes_on = p != none && t - patches.patch[p].first_triangle < triangles_per_patch &&
                             (last[v[0]] == p || last[v[1]] == p || last[v[2]] == p);
        if (!goes_on) {
            p = static_cast<std::uint32_t>(patches.patch.size());
            Patch& patch = patches.patch.emplace_back();
            patch.first_triangle = t;
            patch.first_point = static_cast<std::uint32_t>(patches.point.size());
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t high = std::max(v[k], v[(k + 1) % 3]);
            const std::uint32_t low = std::min(v[k], v[(k + 1) % 3]);
            auto& [nearest, farthest] = patches.neighbour[high];
            if (nearest == high || nearest < low) nearest = low;
            farthest = std::min(farthest, low);
        }
        for (const std::uint32_t corner : v) {
            if (last[corner] == p) continue;
            last[corner] = p;
            patches.point.push_back(corner);
        }
    }
    Patch& end = patches.patch.emplace_back();
    end.first_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
    end.first_point = static_cast<std::uint32_t>(patches.point.size());
}

}  // namespace

Patches patches(const TriangleMesh& mesh, std::span<const TriangleSums> sums, std::span<const Vec3> unit) {
    const auto look = [&](std::uint32_t t) { return unit.empty() ? sums[t].area : unit[t]; };
    assert(sums.size() == mesh.triangles.size() && (unit.empty() || unit.size() == sums.size()));
    Patches result;
    divide(result, mesh);
    assert(result.neighbour.size() == mesh.points.size());
    for (std::size_t p = 0; p < result.count(); ++p) {
        Patch& patch = result.patch[p];
        const std::uint32_t end = result.patch[p + 1].first_triangle;
        assert(patch.first_triangle < end && patch.first_point < result.patch[p + 1].first_point);
        for (std::uint32_t t = patch.first_triangle; t < end; ++t) {
            patch.look = patch.look + look(t);
            patch.volume += sums[t].volume;
        }
        patch.axis = normalized(patch.look);
        double least = 1;  // signed square of the cosine of the triangle farthest from the axis
        for (std::uint32_t t = patch.first_triangle; t < end; ++t) {
            const Vec3 own = look(t);
            const double along = dot(own, patch.axis);
            const double square = dot(own, own);
            if (square > 0) least = std::min(least, along * std::abs(along) / square);
        }
        if (least > 0) patch.cone = std::sqrt(1 - least) + 1e-9;  // with room for rounding
    }
    return result;
}

}  // namespace qchopper
