// A first pass over the triangles finds where clusters begin; a second adds up each cluster and finds its cone of
// normals (L. A. Shirman and S. S. Abi-Ezzi, The cone of normals technique for fast processing of curved patches,
// 1993). O(triangles + points); memory 8 bytes per point for the neighbours, 4 per point of a cluster.
//
// Nine in ten triangles lie between two planes of a normal and only add to a sum, so clusters of at most 16, connected
// runs along a Morton curve (segment/mesh/order.h), are added as a whole where their points lie in one slab. Larger
// ones are crossed too often, smaller ones too many; bounds per cluster, area vectors computed again and prefetching
// were no faster. Cost: the order of triangles in a piece is ours and changes with this rule; files then differ in
// their bytes.

#include "segment/objectives/sweep/clusters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/huge_pages.h"
#include "segment/mesh/order.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Finds where clusters begin. A cluster continues while the next triangle shares a point with it and it is not full.
void divide(Clusters& clusters, const TriangleMesh& mesh) {
    auto last = huge(mesh.points.size(), none);  // per point: the last cluster that lists it
    reserve_huge(clusters.neighbour, mesh.points.size());
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) clusters.neighbour.push_back({v, v});
    reserve_huge(clusters.cluster, mesh.triangles.size() / (triangles_per_cluster / 2));
    reserve_huge(clusters.point, mesh.triangles.size() + mesh.triangles.size() / 8);
    std::uint32_t c = none;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const bool continues = c != none && t - clusters.cluster[c].first_triangle < triangles_per_cluster &&
                               (last[v[0]] == c || last[v[1]] == c || last[v[2]] == c);
        if (!continues) {
            c = static_cast<std::uint32_t>(clusters.cluster.size());
            Cluster& cluster = clusters.cluster.emplace_back();
            cluster.first_triangle = t;
            cluster.first_point = static_cast<std::uint32_t>(clusters.point.size());
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t high = std::max(v[k], v[(k + 1) % 3]);
            const std::uint32_t low = std::min(v[k], v[(k + 1) % 3]);
            auto& [nearest, farthest] = clusters.neighbour[high];
            if (nearest == high || nearest < low) nearest = low;
            farthest = std::min(farthest, low);
        }
        for (const std::uint32_t corner : v) {
            if (last[corner] == c) continue;
            last[corner] = c;
            clusters.point.push_back(corner);
        }
    }
    Cluster& end = clusters.cluster.emplace_back();
    end.first_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
    end.first_point = static_cast<std::uint32_t>(clusters.point.size());
}

}  // namespace

Clusters clusters(const TriangleMesh& mesh, std::span<const TriangleSums> sums, std::span<const Vec3> unit) {
    const auto weighted_normal = [&](std::uint32_t t) { return unit.empty() ? sums[t].area : unit[t]; };
    assert(sums.size() == mesh.triangles.size() && (unit.empty() || unit.size() == sums.size()));
    Clusters result;
    divide(result, mesh);
    assert(result.neighbour.size() == mesh.points.size());
    for (std::size_t c = 0; c < result.count(); ++c) {
        Cluster& cluster = result.cluster[c];
        const std::uint32_t end = result.cluster[c + 1].first_triangle;
        assert(cluster.first_triangle < end && cluster.first_point < result.cluster[c + 1].first_point);
        for (std::uint32_t t = cluster.first_triangle; t < end; ++t) {
            cluster.weighted_normal = cluster.weighted_normal + weighted_normal(t);
            cluster.volume += sums[t].volume;
        }
        cluster.axis = normalized(cluster.weighted_normal);
        double least = 1;  // signed square of the cosine of the triangle farthest from the axis
        for (std::uint32_t t = cluster.first_triangle; t < end; ++t) {
            const Vec3 own = weighted_normal(t);
            const double along = dot(own, cluster.axis);
            const double square = dot(own, own);
            if (square > 0) least = std::min(least, along * std::abs(along) / square);
        }
        if (least > 0) cluster.cone = std::sqrt(1 - least) + 1e-9;  // with a margin for rounding
    }
    return result;
}

}  // namespace qchopper
