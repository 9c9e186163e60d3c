// Seeds by farthest-point sampling, after T. Gonzalez, "Clustering to minimize the maximum intercluster distance"
// (1985); a disc grows from each over the edges. O(triangles + holes * candidates), and O(d^2) for a disc of d
// triangles.

#include "segment/sample/punch.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

constexpr std::size_t max_candidates = 20000;
constexpr std::array<double, 4> disc_radius{0.012, 0.02, 0.008, 0.028};  // of the diagonal, used in turn

// Points far from each other: each is the farthest from those before it.
std::vector<std::uint32_t> spread(const TriangleMesh& mesh, std::size_t count, double& min_distance) {
    const std::size_t stride = mesh.points.size() / max_candidates + 1;
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
    min_distance = std::sqrt(least2);
    return chosen;
}

// Grows one disc at a time, and collects the triangles outside all discs.
class Punch {
 public:
    explicit Punch(const TriangleMesh& mesh)
        : mesh_(mesh),
          edges_(edges(mesh)),
          any_(mesh.points.size()),
          is_kept_(mesh.triangles.size(), true),
          touched_(mesh.points.size()) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t corner : mesh.triangles[t]) any_[corner] = t;
        }
    }

    // False if there is no room for a disc.
    bool add_disc(std::uint32_t seed, double radius) {
        // never less than the triangles around one point: those always make a disc
        for (double r = radius; r > 0.05 * radius; r *= 0.6) {
            if (try_disc(grown(seed, r))) return true;
        }
        return try_disc(grown(seed, 0));
    }

    const std::vector<bool>& is_kept() const { return is_kept_; }

 private:
    // The triangles around the seed, and those connected with them within the radius.
    std::vector<std::uint32_t> grown(std::uint32_t seed, double radius) const {
        std::vector<std::uint32_t> disc{any_[seed]};
        for (std::size_t i = 0; i < disc.size(); ++i) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t next = edges_.twin[3 * disc[i] + k] / 3;
                if (!belongs(next, seed, radius)) continue;
                if (std::find(disc.begin(), disc.end(), next) == disc.end()) disc.push_back(next);
                if (disc.size() > max_triangles) return disc;
            }
        }
        return disc;
    }

    bool belongs(std::uint32_t triangle, std::uint32_t seed, double radius) const {
        bool is_near = true;
        for (const std::uint32_t corner : mesh_.triangles[triangle]) {
            if (corner == seed) return true;
            is_near &= norm(mesh_.points[corner] - mesh_.points[seed]) <= radius;
        }
        return is_near;
    }

    // A disc has Euler characteristic 1 and its border passes every point once; it has no point of another disc.
    bool try_disc(const std::vector<std::uint32_t>& disc) {
        std::vector<std::uint32_t> sorted = disc;
        std::sort(sorted.begin(), sorted.end());
        const auto in_disc = [&](std::uint32_t t) { return std::binary_search(sorted.begin(), sorted.end(), t); };
        std::vector<std::uint32_t> points;
        std::vector<std::uint32_t> starts;  // of border edges
        for (const std::uint32_t t : disc) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = mesh_.triangles[t][k];
                if (touched_[corner]) return false;
                points.push_back(corner);
                if (!in_disc(edges_.twin[3 * t + k] / 3)) starts.push_back(corner);
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
        const std::size_t edge_count = (3 * disc.size() + border) / 2;
        if (points.size() + disc.size() != edge_count + 1) return false;
        for (const std::uint32_t t : disc) is_kept_[t] = false;
        for (const std::uint32_t p : points) touched_[p] = true;
        return true;
    }

    static constexpr std::size_t max_triangles = 20000;

    const TriangleMesh& mesh_;
    Edges edges_;
    std::vector<std::uint32_t> any_;  // one per point: one of its triangles
    std::vector<bool> is_kept_;
    std::vector<bool> touched_;  // points of the discs so far
};

}  // namespace

int punch_holes(TriangleMesh& mesh, int holes) {
    if (holes <= 0) return 0;
    double apart = 0;
    const std::vector<std::uint32_t> seeds = spread(mesh, static_cast<std::size_t>(holes), apart);
    const double diagonal = norm(bounds(mesh).size());
    Punch punch(mesh);
    int made = 0;
    for (const std::uint32_t seed : seeds) {
        const double radius = disc_radius[static_cast<std::size_t>(made) % disc_radius.size()] * diagonal;
        made += punch.add_disc(seed, std::min(radius, apart / 4)) ? 1 : 0;
    }
    keep_triangles(mesh, punch.is_kept());
    std::vector<bool> is_used(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) is_used[corner] = true;
    }
    std::vector<std::uint32_t> number(mesh.points.size());
    std::exclusive_scan(is_used.begin(), is_used.end(), number.begin(), 0U);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = number[corner];
    }
    keep_marked(mesh.points, is_used);
    return made;
}

}  // namespace qchopper
