// The samples lie in a grid whose cells are as wide as their spacing, so that the nearest one is in 27 cells.

#include "cam/setup/paint_narrow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr std::size_t triangles_at_once = 4096;

class SampleGrid {
 public:
    SampleGrid(const SurfaceSamples& samples, double spacing) : samples_(samples), spacing_(spacing) {
        for (std::uint32_t i = 0; i < samples.sample.size(); ++i) {
            cells_[key(place(samples.sample[i].point), 0, 0, 0)].push_back(i);
        }
    }

    // samples.size() if none is as near as the spacing.
    std::size_t nearest(Vec3 point) const {
        std::size_t best = samples_.sample.size();
        double least = spacing_ * spacing_;
        const Place at = place(point);
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                for (int z = -1; z <= 1; ++z) look_at(key(at, x, y, z), point, best, least);
            }
        }
        return best;
    }

 private:
    struct Place {
        std::int64_t x, y, z;
    };
    Place place(Vec3 p) const {
        const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / spacing_)); };
        return {cell(p.x), cell(p.y), cell(p.z)};
    }
    // Different cells may share a key; that costs time only, because distances decide.
    static std::uint64_t key(Place at, int x, int y, int z) {
        const auto part = [](std::int64_t v) { return static_cast<std::uint64_t>(v) & 0x1FFFFF; };
        return part(at.x + x) << 42 | part(at.y + y) << 21 | part(at.z + z);
    }
    void look_at(std::uint64_t cell, Vec3 point, std::size_t& best, double& least) const {
        const auto found = cells_.find(cell);
        if (found == cells_.end()) return;
        for (const std::uint32_t i : found->second) {
            const Vec3 away = samples_.sample[i].point - point;
            const double distance = dot(away, away);
            if (distance >= least) continue;
            least = distance;
            best = i;
        }
    }

    const SurfaceSamples& samples_;
    double spacing_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

void paint_narrow(const TriangleMesh& mesh, const SurfaceSamples& samples, const std::vector<bool>& is_narrow,
                  std::vector<SurfaceState>& states) {
    if (std::count(is_narrow.begin(), is_narrow.end(), true) == 0) return;
    const SampleGrid grid(samples, std::sqrt(2 * samples.area_each_mm2));
    parallel_ranges(0, mesh.triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            if (states[t] != SurfaceState::reached || cap_of(mesh, t) != no_cap) continue;
            const auto corner = corners_of(mesh, t);
            const std::size_t sample = grid.nearest((1.0 / 3) * (corner[0] + corner[1] + corner[2]));
            if (sample < is_narrow.size() && is_narrow[sample]) states[t] = SurfaceState::too_narrow;
        }
    });
}

}  // namespace qchopper
