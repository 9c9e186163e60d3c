#include "segment/mesh/sampled_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

using Places = std::array<Vec3, 3>;

Places places_of(const TriangleMesh& mesh, std::size_t t) {
    const Triangle& c = mesh.triangles[t];
    return {mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]};
}

double longest_side(const Places& p) {
    return std::max({norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])});
}

double mean_longest_side(const TriangleMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += longest_side(places_of(mesh, t));
    return sum / static_cast<double>(mesh.triangles.size());
}

// Only the largest distance counts: a sample that is closer than that to a triangle which was nearest to one of the
// last samples need not be asked for. Nearly none is.
class Farthest {
 public:
    explicit Farthest(const TriangleMesh& to) : to_(to), tree_(to) {}

    void look_at(Vec3 p) {
        for (std::size_t i = 0; i < nearest_.size(); ++i) {
            const Vec3 away = closest_on_triangle(p, places_of(to_, nearest_[i])) - p;
            if (dot(away, away) > mm_ * mm_) continue;
            if (i > 0) std::swap(nearest_[i], nearest_[i - 1]);
            return;
        }
        const TriangleTree::Nearest found = tree_.nearest(to_, p);
        mm_ = std::max(mm_, found.distance);
        std::rotate(nearest_.begin(), nearest_.end() - 1, nearest_.end());
        nearest_.front() = found.triangle;
    }

    double mm() const { return mm_; }

 private:
    const TriangleMesh& to_;
    TriangleTree tree_;
    std::array<std::uint32_t, 8> nearest_{};
    double mm_ = 0;
};

// A grid of n steps along each side, and the middles of its upright cells.
void look_at_face(Farthest& farthest, const Places& p, int n) {
    const Vec3 u = (1.0 / n) * (p[1] - p[0]);
    const Vec3 v = (1.0 / n) * (p[2] - p[0]);
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; i + k <= n; ++k) {
            const Vec3 corner = p[0] + static_cast<double>(i) * u + static_cast<double>(k) * v;
            farthest.look_at(corner);
            if (i + k < n) farthest.look_at(corner + (1.0 / 3) * (u + v));
        }
    }
}

}  // namespace

double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context) {
    constexpr int most_steps = 200;
    const double spacing = mean_longest_side(to);
    Farthest farthest(to);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        if (t % 4096 == 0) context.check_cancelled();
        const Places places = places_of(from, t);
        const double steps = std::ceil(longest_side(places) / std::max(spacing, 1e-12));
        look_at_face(farthest, places, std::clamp(static_cast<int>(std::min(steps, 1e6)), 2, most_steps));
    }
    return farthest.mm();
}

}  // namespace qchopper
