// Faces or vertices in chunks of fixed size, in parallel; for each the offsets within the distance by binary search.
// The rays of all offsets are one batch (parallel_rays.h). O(n log k + pairs of a face or vertex and a near offset) for
// k offsets, and the rays; memory per ray, and for the thesis' form one sum per chunk and offset.

#include "segment/objectives/sweep/fragility_sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "segment/objectives/thin_part.h"
#include "segment/raster/parallel_rays.h"

namespace qchopper {
namespace {

// Faces or vertices of one task. Fixed, so that sums do not depend on the number of threads.
constexpr std::size_t chunk = 8192;

// Sums per offset over `count` items; the chunks are added up in their order.
template <typename AddChunk>
std::vector<double> sum_chunks(std::size_t count, std::size_t offsets, const AddChunk& add_chunk) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::vector<double> partial(chunks * offsets, 0.0);
    parallel_for(0, chunks, [&](std::size_t c) {
        add_chunk(c * chunk, std::min(count, (c + 1) * chunk),
                  std::span<double>(partial.data() + c * offsets, offsets));
    });
    std::vector<double> sum(offsets, 0.0);
    for (std::size_t c = 0; c < chunks; ++c) {
        for (std::size_t j = 0; j < offsets; ++j) sum[j] += partial[c * offsets + j];
    }
    return sum;
}

// A ray from a face, or from its part, towards planes. A face has one ray for all planes that do not cross it.
struct ThinQuery {
    RayQuery ray;
    double area;
    double along;
    std::uint32_t from;  // planes [from, to)
    std::uint32_t to;
};

// Adds the queries of one face that is nearly parallel to the planes: one for the whole face, and one for its part at
// each plane that crosses it.
void add_queries(std::vector<ThinQuery>& queries, const TriangleMesh& mesh, std::size_t triangle, Vec3 normal,
                 double along, std::span<const double> offsets, double distance) {
    const Triangle& v = mesh.triangles[triangle];
    const double h[3] = {height(normal, mesh.points[v[0]]), height(normal, mesh.points[v[1]]),
                         height(normal, mesh.points[v[2]])};
    const double low = std::min({h[0], h[1], h[2]});
    const double high = std::max({h[0], h[1], h[2]});
    const bool above = along > 0;
    const double reach = distance + 1e-9 * (1 + std::abs(low));
    const auto index = [&](auto it) { return static_cast<std::uint32_t>(it - offsets.begin()); };
    // Offsets up to `low` leave the face whole above the plane, those over `high` whole below; between, they cross it.
    const auto crossed_from = std::upper_bound(offsets.begin(), offsets.end(), low);
    const auto crossed_to = std::upper_bound(crossed_from, offsets.end(), high);
    const auto whole_from = above ? std::lower_bound(offsets.begin(), crossed_from, low - reach) : crossed_to;
    const auto whole_to = above ? crossed_from : std::upper_bound(crossed_to, offsets.end(), high + reach);
    if (whole_from != whole_to) {
        const Centroid c = centroid(thin_part(mesh, triangle, {normal, *whole_from}, above));
        // The ray looks as far as the farthest plane, which is the first below or the last above.
        const double farthest = std::abs(height(normal, c.at) - (above ? *whole_from : *(whole_to - 1)));
        if (c.area > 0)
            queries.push_back({{c.at, !above, farthest}, c.area, along, index(whole_from), index(whole_to)});
    }
    for (auto it = crossed_from; it != crossed_to; ++it) {
        const Centroid c = centroid(thin_part(mesh, triangle, {normal, *it}, above));
        const double off = std::abs(height(normal, c.at) - *it);
        if (c.area > 0) queries.push_back({{c.at, !above, off}, c.area, along, index(it), index(it) + 1});
    }
}

// Whether no triangle of a cluster is nearly parallel to the planes, by the cone of its normals.
bool is_steep(const Cluster& cluster, Vec3 normal) {
    constexpr double rounding = 1e-6;
    if (cluster.cone >= 1) return false;
    const double along = std::min(1.0, std::abs(dot(cluster.axis, normal)));
    const double across = std::sqrt(1 - along * along);
    if (across <= cluster.cone) return false;  // the cone holds the normal or its opposite
    // the cosine of the angle between the normal and the side of the cone that is nearest to it
    return along * std::sqrt(1 - cluster.cone * cluster.cone) + across * cluster.cone < nearly_parallel - rounding;
}

}  // namespace

std::vector<double> sweep_thinness(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                   double distance) {
    const TriangleMesh& mesh = *prepared.piece->mesh;
    constexpr std::size_t clusters_at_once = 512;
    const std::size_t count = prepared.clusters.count();
    std::vector<std::vector<ThinQuery>> by_chunk((count + clusters_at_once - 1) / clusters_at_once);
    parallel_for(0, by_chunk.size(), [&](std::size_t c) {
        for (std::size_t k = c * clusters_at_once; k < std::min(count, (c + 1) * clusters_at_once); ++k) {
            const Cluster& cluster = prepared.clusters.cluster[k];
            // The cones hold the area vectors only where those are what undercut projects.
            if (prepared.unit.empty() && is_steep(cluster, normal)) continue;
            const std::uint32_t end = prepared.clusters.cluster[k + 1].first_triangle;
            for (std::uint32_t t = cluster.first_triangle; t < end; ++t) {
                const Vec3 area = prepared.sums[t].area;
                const double projected = dot(area, normal);
                // A cheap test with a margin for rounding; the test below decides, by the same bits as the plain sum.
                if (projected * projected < 0.80 * dot(area, area)) continue;
                const double along = dot(normalized(area), normal);
                if (std::abs(along) < nearly_parallel) continue;
                add_queries(by_chunk[c], mesh, t, normal, along, offsets, distance);
            }
        }
    });
    std::vector<RayQuery> queries;
    for (const auto& some : by_chunk) {
        for (const ThinQuery& q : some) queries.push_back(q.ray);
    }
    const std::vector<double> free_lengths = ray_distances(mesh, normal, queries);
    assert(free_lengths.size() == queries.size());
    std::vector<double> sums(offsets.size(), 0.0);
    std::size_t next = 0;
    for (const auto& some : by_chunk) {
        for (const ThinQuery& q : some) {
            const double free_length = free_lengths[next++];
            const double h = height(normal, q.ray.from);
            for (std::uint32_t j = q.from; j < q.to; ++j) {
                const double off = std::abs(h - offsets[j]);
                if (off < distance && free_length >= off) sums[j] += q.area * (1 - off / distance) * std::abs(q.along);
            }
        }
    }
    return sums;
}

std::vector<double> sweep_thesis_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance) {
    const TriangleMesh& mesh = *prepared.piece->mesh;
    assert(prepared.vertex_normals.size() == mesh.points.size());
    return sum_chunks(mesh.points.size(), offsets.size(), [&](std::size_t begin, std::size_t end, auto sums) {
        for (std::size_t v = begin; v < end; ++v) {
            const double along = std::abs(dot(prepared.vertex_normals[v], normal));
            if (along < nearly_parallel) continue;
            const double h = height(normal, mesh.points[v]);
            const double reach = distance + 1e-9 * (1 + std::abs(h));
            for (auto it = std::lower_bound(offsets.begin(), offsets.end(), h - reach);
                 it != offsets.end() && *it <= h + reach; ++it) {
                const double off = std::abs(h - *it);
                if (off <= distance) sums[static_cast<std::size_t>(it - offsets.begin())] += off * along;
            }
        }
    });
}

}  // namespace qchopper
