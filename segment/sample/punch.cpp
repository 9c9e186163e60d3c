#include "segment/sample/punch.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/edges.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr std::size_t most_candidates = 20000;
constexpr std::array<double, 4> patch_radius{0.012, 0.02, 0.008, 0.028};  // of the diagonal, taken in turn

// Points far from each other, each the farthest from those before it.
std::vector<std::uint32_t> spread(const TriangleMesh& mesh, std::size_t count, double& least_distance) {
    const std::size_t stride = mesh.points.size() / most_candidates + 1;
    std::vector<double> distance2((mesh.points.size() + stride - 1) / stride, std::numeric_limits<double>::max());
    std::vector<std::uint32_t> chosen;
    std::size_t next = 0;
    double least2 = std::numeric_limits<double>::max();
    while (chosen.size() < count) {
        if (!chosen.empty()) least2 = std::min(least2, distance2[next]);
        chosen.push_back(static_cast<std::uint32_t>(next * stride));
        const Vec3 seed = mesh.points[chosen.back()];
        for (std::size_t i = 0; i < distance2.size(); ++i) {
            const Vec3 d = mesh.points[i * stride] - seed;
            distance2[i] = std::min(distance2[i], dot(d, d));
        }
        next = static_cast<std::size_t>(std::max_element(distance2.begin(), distance2.end()) - distance2.begin());
        if (distance2[next] == 0) break;
    }
    least_distance = std::sqrt(least2);
    return chosen;
}

// Grows one patch at a time; `gone` holds the triangles of all.
class Punch {
 public:
    explicit Punch(const TriangleMesh& mesh)
        : mesh_(mesh),
          edges_(edges(mesh)),
          any_(mesh.points.size()),
          gone_(mesh.triangles.size()),
          touched_(mesh.points.size()) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t corner : mesh.triangles[t]) any_[corner] = t;
        }
    }

    bool take(std::uint32_t seed, double radius) {
        // never less than the triangles around one point: those always make a disc
        for (double r = radius; r > 0.05 * radius; r *= 0.6) {
            if (try_patch(grown(seed, r))) return true;
        }
        return try_patch(grown(seed, 0));
    }

    const std::vector<bool>& gone() const { return gone_; }

 private:
    // The triangles around the seed, and those that hang together with them within the radius.
    std::vector<std::uint32_t> grown(std::uint32_t seed, double radius) const {
        std::vector<std::uint32_t> patch{any_[seed]};
        for (std::size_t i = 0; i < patch.size(); ++i) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t next = edges_.twin[3 * patch[i] + k] / 3;
                if (!belongs(next, seed, radius)) continue;
                if (std::find(patch.begin(), patch.end(), next) == patch.end()) patch.push_back(next);
                if (patch.size() > most_triangles) return patch;
            }
        }
        return patch;
    }

    bool belongs(std::uint32_t triangle, std::uint32_t seed, double radius) const {
        bool is_near = true;
        for (const std::uint32_t corner : mesh_.triangles[triangle]) {
            if (corner == seed) return true;
            is_near &= norm(mesh_.points[corner] - mesh_.points[seed]) <= radius;
        }
        return is_near;
    }

    // A disc has Euler characteristic 1 and passes every border point once; it keeps off the other patches.
    bool try_patch(const std::vector<std::uint32_t>& patch) {
        std::vector<std::uint32_t> sorted = patch;
        std::sort(sorted.begin(), sorted.end());
        const auto in_patch = [&](std::uint32_t t) { return std::binary_search(sorted.begin(), sorted.end(), t); };
        std::vector<std::uint32_t> points;
        std::vector<std::uint32_t> starts;  // of border edges
        for (const std::uint32_t t : patch) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = mesh_.triangles[t][k];
                if (touched_[corner]) return false;
                points.push_back(corner);
                if (!in_patch(edges_.twin[3 * t + k] / 3)) starts.push_back(corner);
            }
        }
        const auto make_unique = [](std::vector<std::uint32_t>& list) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        };
        make_unique(points);
        const std::size_t border = starts.size();
        make_unique(starts);
        if (starts.size() != border) return false;
        const std::size_t edge_count = (3 * patch.size() + border) / 2;
        if (points.size() + patch.size() != edge_count + 1) return false;
        for (const std::uint32_t t : patch) gone_[t] = true;
        for (const std::uint32_t p : points) touched_[p] = true;
        return true;
    }

    static constexpr std::size_t most_triangles = 20000;

    const TriangleMesh& mesh_;
    Edges edges_;
    std::vector<std::uint32_t> any_;  // per point, one of its triangles
    std::vector<bool> gone_;
    std::vector<bool> touched_;  // points of the patches so far
};

}  // namespace

int punch_holes(TriangleMesh& mesh, int holes) {
    if (holes <= 0) return 0;
    double apart = 0;
    const std::vector<std::uint32_t> seeds = spread(mesh, static_cast<std::size_t>(holes), apart);
    const double diagonal = norm(bounds(mesh).size());
    Punch punch(mesh);
    int taken = 0;
    for (const std::uint32_t seed : seeds) {
        const double radius = patch_radius[static_cast<std::size_t>(taken) % patch_radius.size()] * diagonal;
        taken += punch.take(seed, std::min(radius, apart / 4)) ? 1 : 0;
    }
    TriangleMesh open;
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(mesh.points.size(), unused);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (punch.gone()[t]) continue;
        for (const std::uint32_t corner : mesh.triangles[t]) place[corner] = 0;
        open.triangles.push_back(mesh.triangles[t]);
    }
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (place[v] == unused) continue;
        place[v] = static_cast<std::uint32_t>(open.points.size());
        open.points.push_back(mesh.points[v]);
    }
    for (Triangle& t : open.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
    }
    mesh = std::move(open);
    return taken;
}

}  // namespace qchopper
