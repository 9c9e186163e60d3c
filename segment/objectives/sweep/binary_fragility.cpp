// The sweep: vertices that may count are sorted by the slab between two offsets that they lie in. Planes that are not
// decided yet ask the nearest vertices of each side first, in rounds of growing size; the rays of a round are one batch
// (parallel_rays.h). Only where normals alone do not decide all planes are the edges around vertices looked at. Per
// normal O(vertices log offsets), and at most a ray per vertex.

#include "segment/objectives/sweep/binary_fragility.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "segment/mesh/normals.h"
#include "segment/objectives/thin_part.h"
#include "segment/raster/parallel_rays.h"

namespace qchopper {
namespace {

// A vertex with one of the normals that it is asked with: that of its triangles, or that of a cap that it belongs to.
struct NormalAt {
    std::uint32_t point = 0;
    double along = 0;  // the normal . the plane's
};

// Those of the caps first.
std::vector<NormalAt> normals_along(std::span<const CapPoint> of_caps, std::span<const Vec3> of_points, Vec3 normal) {
    std::vector<NormalAt> all;
    all.reserve(of_caps.size() + of_points.size());
    for (const CapPoint& c : of_caps) all.push_back({c.point, dot(c.outward, normal)});
    for (std::uint32_t v = 0; v < of_points.size(); ++v) all.push_back({v, dot(of_points[v], normal)});
    return all;
}

// Per point how often the edges around it change between upwards and downwards.
std::vector<std::uint32_t> turns(const TriangleMesh& mesh, Vec3 normal) {
    std::vector<double> h(mesh.points.size());
    for (std::size_t v = 0; v < h.size(); ++v) h[v] = height(normal, mesh.points[v]);
    std::vector<std::uint32_t> count(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double own = h[t[k]];
            if ((h[t[(k + 1) % 3]] >= own) != (h[t[(k + 2) % 3]] >= own)) ++count[t[k]];
        }
    }
    return count;
}

constexpr std::uint32_t turns_of_a_slope = 2;

bool looks_away(double along) {
    return std::abs(along) >= nearly_parallel;
}

bool may_count(const NormalAt& at, const std::vector<std::uint32_t>& turns) {
    return looks_away(at.along) || (at.along != 0 && turns[at.point] != turns_of_a_slope);
}

// The planes of one normal, and which of them are known to be fragile.
class BinarySweep {
 public:
    BinarySweep(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets, double distance)
        : mesh_(*prepared.piece->mesh),
          normal_(normal),
          offsets_(offsets),
          distance_(distance),
          is_fragile_(offsets.size(), 0.0) {}

    // Asks these vertices for all planes that are not decided.
    void ask(std::vector<NormalAt> vertices) {
        sort_by_slab(std::move(vertices));
        for (std::size_t most = 1; ask_nearest(most); most *= growth) {
        }
    }
    bool is_decided() const {
        return std::all_of(is_fragile_.begin(), is_fragile_.end(), [](double f) { return f > 0; });
    }
    const std::vector<double>& values() const { return is_fragile_; }

 private:
    static constexpr std::size_t growth = 16;
    struct Vertex {
        std::uint32_t point;
        bool above;  // it lies above the planes for which it counts
        double height;
        bool is_asked;
    };

    // Those that count for no plane are left out.
    void sort_by_slab(std::vector<NormalAt> vertices) {
        std::vector<std::uint32_t> slab(vertices.size());
        first_.assign(offsets_.size() + 2, 0);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const double h = height(normal_, mesh_.points[vertices[i].point]);
            const auto at = std::upper_bound(offsets_.begin(), offsets_.end(), h);
            slab[i] = static_cast<std::uint32_t>(at - offsets_.begin());
            ++first_[slab[i] + 1];
        }
        for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
        vertex_.resize(vertices.size());
        std::vector<std::size_t> next(first_.begin(), first_.end());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const NormalAt& v = vertices[i];
            vertex_[next[slab[i]]++] = {v.point, v.along > 0, height(normal_, mesh_.points[v.point]), false};
        }
    }

    bool is_near(const Vertex& v, double offset) const {
        return (v.above ? v.height >= offset : v.height < offset) && std::abs(v.height - offset) <= distance_;
    }

    // Up to `most` vertices on each side of each plane that is not decided, the nearest slabs first. False: none is
    // left.
    bool ask_nearest(std::size_t most) {
        asked_.clear();
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            if (is_fragile_[j] > 0) continue;
            collect(j, most, true);
            collect(j, most, false);
        }
        if (asked_.empty()) return false;
        std::vector<RayQuery> rays;
        rays.reserve(asked_.size());
        for (const std::size_t i : asked_) {
            rays.push_back({mesh_.points[vertex_[i].point], !vertex_[i].above, distance_});
        }
        const std::vector<double> free_lengths = ray_distances(mesh_, normal_, rays);
        for (std::size_t k = 0; k < asked_.size(); ++k) decide(vertex_[asked_[k]], free_lengths[k]);
        return true;
    }

    void collect(std::size_t plane, std::size_t most, bool above) {
        const double offset = offsets_[plane];
        std::size_t slab = above ? plane + 1 : plane;
        for (std::size_t found = 0; found < most;) {
            for (std::size_t i = first_[slab]; i < first_[slab + 1] && found < most; ++i) {
                Vertex& v = vertex_[i];
                if (v.is_asked || v.above != above || !is_near(v, offset)) continue;
                v.is_asked = true;
                asked_.push_back(i);
                ++found;
            }
            if (above ? slab == offsets_.size() || offsets_[slab] > offset + distance_
                      : slab == 0 || offsets_[slab - 1] < offset - distance_)
                return;
            slab += above ? 1 : std::size_t(-1);
        }
    }

    void decide(const Vertex& v, double free_length) {
        const double reach = distance_ + 1e-9 * (1 + std::abs(v.height));
        for (auto it = std::lower_bound(offsets_.begin(), offsets_.end(), v.height - reach);
             it != offsets_.end() && *it <= v.height + reach; ++it) {
            if (is_near(v, *it) && free_length >= std::abs(v.height - *it))
                is_fragile_[static_cast<std::size_t>(it - offsets_.begin())] = 1;
        }
    }

    const TriangleMesh& mesh_;
    Vec3 normal_;
    std::span<const double> offsets_;
    double distance_;
    std::vector<double> is_fragile_;  // 1 or 0
    std::vector<Vertex> vertex_;      // slab by slab
    std::vector<std::size_t> first_;  // per slab, and one more
    std::vector<std::size_t> asked_;
};

}  // namespace

std::vector<double> sweep_binary_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance) {
    const TriangleMesh& mesh = *prepared.piece->mesh;
    assert(prepared.vertex_normals.size() == mesh.points.size());
    BinarySweep sweep(prepared, normal, offsets, distance);
    const std::vector<NormalAt> all = normals_along(prepared.cap_points, prepared.vertex_normals, normal);
    std::vector<NormalAt> away;
    std::copy_if(all.begin(), all.end(), std::back_inserter(away),
                 [](const NormalAt& v) { return looks_away(v.along); });
    sweep.ask(std::move(away));
    if (sweep.is_decided()) return sweep.values();
    const std::vector<std::uint32_t> around = turns(mesh, normal);
    std::vector<NormalAt> others;
    std::copy_if(all.begin(), all.end(), std::back_inserter(others),
                 [&](const NormalAt& v) { return !looks_away(v.along) && may_count(v, around); });
    sweep.ask(std::move(others));
    return sweep.values();
}

}  // namespace qchopper
