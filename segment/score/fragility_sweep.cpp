#include "segment/score/fragility_sweep.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "segment/score/thin_part.h"

namespace qchopper {
namespace {

constexpr std::size_t chunk = 8192;  // faces or vertices summed up by one task; fixed, so sums do not depend on threads

// Sums per offset over chunks of `count` things, in the order of the chunks.
template <typename AddChunk>
std::vector<double> sum_chunks(std::size_t count, std::size_t offsets, const AddChunk& add_chunk) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::vector<double> partial(chunks * offsets, 0.0);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
        add_chunk(c * chunk, std::min(count, (c + 1) * chunk),
                  std::span<double>(partial.data() + c * offsets, offsets));
    });
    std::vector<double> sum(offsets, 0.0);
    for (std::size_t c = 0; c < chunks; ++c) {
        for (std::size_t j = 0; j < offsets; ++j) sum[j] += partial[c * offsets + j];
    }
    return sum;
}

// One face that is nearly parallel to the planes.
class ThinFace {
 public:
    ThinFace(const PreparedPiece& prepared, const RayTree& rays, std::size_t triangle, Vec3 normal, double along)
        : piece_(*prepared.piece), rays_(rays), triangle_(triangle), normal_(normal), along_(along) {}

    // To all planes that see the face from behind within `distance`. Whole faces share one ray.
    void add_to(std::span<double> sums, std::span<const double> offsets, double distance) const {
        const Triangle& v = piece_.mesh->triangles[triangle_];
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const std::uint32_t p : v) {
            const double h = height(normal_, piece_.mesh->points[p]);
            low = std::min(low, h);
            high = std::max(high, h);
        }
        const bool above = along_ > 0;
        // Planes below `low` leave the face whole above them, planes above `high` whole below.
        const auto from = std::upper_bound(offsets.begin(), offsets.end(), above ? low - distance - slack(low) : low);
        const auto to = std::lower_bound(from, offsets.end(), above ? high : high + distance + slack(high));
        Centroid whole;
        double way = -1;
        for (auto it = from; it != to; ++it) {
            const Plane plane{normal_, *it};
            const bool is_crossed = *it > low && *it <= high;
            Centroid c = whole;
            if (is_crossed || way < 0) c = centroid(part_of(*piece_.mesh, triangle_, plane, above));
            if (c.area == 0) continue;
            const double off = std::abs(height(normal_, c.at) - *it);
            if (off >= distance) continue;
            double free = way;
            if (is_crossed || way < 0) free = free_way(piece_, rays_, c.at, above ? -normal_ : normal_);
            if (!is_crossed && way < 0) {
                whole = c;
                way = free;
            }
            if (free < off) continue;
            sums[static_cast<std::size_t>(it - offsets.begin())] += c.area * (1 - off / distance) * std::abs(along_);
        }
    }

 private:
    static double slack(double h) { return 1e-9 * (1 + std::abs(h)); }

    const Piece& piece_;
    const RayTree& rays_;
    std::size_t triangle_;
    Vec3 normal_;
    double along_;
};

}  // namespace

std::vector<double> sweep_thinness(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                   double distance, const RayTree& scan_rays) {
    return sum_chunks(prepared.sums.size(), offsets.size(), [&](std::size_t begin, std::size_t end, auto sums) {
        for (std::size_t t = begin; t < end; ++t) {
            const Vec3 area = prepared.sums[t].area;
            const double projected = dot(area, normal);
            // Cheap first, with room for rounding; the face itself decides by the same bits as the plain sum.
            if (projected * projected < 0.80 * dot(area, area)) continue;
            const double along = dot(normalized(area), normal);
            if (std::abs(along) < nearly_parallel) continue;
            ThinFace(prepared, scan_rays, t, normal, along).add_to(sums, offsets, distance);
        }
    });
}

std::vector<double> sweep_thesis_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance) {
    const TriangleMesh& mesh = *prepared.piece->mesh;
    return sum_chunks(mesh.points.size(), offsets.size(), [&](std::size_t begin, std::size_t end, auto sums) {
        for (std::size_t v = begin; v < end; ++v) {
            const double along = std::abs(dot(prepared.vertex_normals[v], normal));
            if (along < nearly_parallel) continue;
            const double h = height(normal, mesh.points[v]);
            const double room = distance + 1e-9 * (1 + std::abs(h));
            for (auto it = std::lower_bound(offsets.begin(), offsets.end(), h - room);
                 it != offsets.end() && *it <= h + room; ++it) {
                const double off = std::abs(h - *it);
                if (off <= distance) sums[static_cast<std::size_t>(it - offsets.begin())] += off * along;
            }
        }
    });
}

}  // namespace qchopper
