// Samples of faces after P. Cignoni, C. Rocchini and R. Scopigno, "Metro: measuring error on simplified surfaces"
// (1998), but for samples that cannot be the farthest: those no farther from any triangle than the largest distance
// found. The triangles that are tried are the last one that was so near and those in the cell of a grid; only if none
// is, a tree is searched. O(samples), and O(log triangles) on average for each that is searched for; a triangle tree
// and a grid of `to` in memory.

#include "segment/simplify/sampled_deviation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

using TriangleCorners = std::array<Vec3, 3>;

double longest_side(const TriangleCorners& p) {
    return std::max({norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])});
}

double mean_longest_side(const TriangleMesh& mesh) {
    double sum = 0;
    double faces = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        sum += longest_side(corners_of(mesh, t));
        ++faces;
    }
    return sum / std::max(1.0, faces);
}

// The places of the triangles of a tree by the cells of a grid that their boxes touch. A triangle that touches many
// cells is in none: the grid proposes triangles, and need not have all.
class TriangleGrid {
 public:
    TriangleGrid(const TriangleTree& tree, double cell_mm) {
        constexpr double max_cells = 1 << 21;
        const FloatBox& all = tree.of_node[1];
        low_ = all.min;
        double cell = std::max(cell_mm, 1e-9);
        const auto along = [&](std::size_t axis) { return (double{all.max[axis]} - all.min[axis]) / cell + 1; };
        while (along(0) * along(1) * along(2) > max_cells) cell *= 1.5;
        per_mm_ = static_cast<float>(1 / cell);
        for (std::size_t axis = 0; axis < 3; ++axis) cells_[axis] = static_cast<std::size_t>(along(axis));
        first_.assign(cells_[0] * cells_[1] * cells_[2] + 2, 0);
        for_each_entry(tree, [&](std::size_t cell_number, std::uint32_t) { ++first_[cell_number + 2]; });
        for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
        places_.resize(first_.back());
        for_each_entry(
            tree, [&](std::size_t cell_number, std::uint32_t place) { places_[first_[cell_number + 1]++] = place; });
    }

    // Those in the cell of a point in the coordinates of the tree, or in the cell nearest to it.
    std::span<const std::uint32_t> places_at(const std::array<float, 3>& at) const {
        const std::size_t cell = number({cell_at(at, 0), cell_at(at, 1), cell_at(at, 2)});
        return std::span(places_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }

 private:
    template <class Visit>
    void for_each_entry(const TriangleTree& tree, const Visit& visit) const {
        constexpr std::size_t max_per_triangle = 64;
        for (std::uint32_t place = 0; place < tree.of_triangle.size(); ++place) {
            const FloatBox& box = tree.of_triangle[place];
            const std::array<std::size_t, 3> from{cell_at(box.min, 0), cell_at(box.min, 1), cell_at(box.min, 2)};
            const std::array<std::size_t, 3> to{cell_at(box.max, 0), cell_at(box.max, 1), cell_at(box.max, 2)};
            const std::size_t touched = (to[0] - from[0] + 1) * (to[1] - from[1] + 1) * (to[2] - from[2] + 1);
            if (touched > max_per_triangle) continue;
            for (std::size_t z = from[2]; z <= to[2]; ++z) {
                for (std::size_t y = from[1]; y <= to[1]; ++y) {
                    for (std::size_t x = from[0]; x <= to[0]; ++x) visit(number({x, y, z}), place);
                }
            }
        }
    }

    std::size_t cell_at(const std::array<float, 3>& at, std::size_t axis) const {
        const float last = static_cast<float>(cells_[axis] - 1);
        return static_cast<std::size_t>(std::clamp((at[axis] - low_[axis]) * per_mm_, 0.0F, last));
    }
    std::size_t number(const std::array<std::size_t, 3>& cell) const {
        return (cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0];
    }

    std::array<float, 3> low_{};
    float per_mm_ = 0;
    std::array<std::size_t, 3> cells_{1, 1, 1};
    std::vector<std::uint32_t> first_;  // per cell, in places_
    std::vector<std::uint32_t> places_;
};

// What samples are compared with.
struct Surface {
    const TriangleMesh& mesh;
    TriangleTree tree;
    double spacing;  // mm between samples
    TriangleGrid grid;
    double rounding;  // mm, more than the error of any distance

    explicit Surface(const TriangleMesh& to)
        : mesh(to), tree(to), spacing(std::max(mean_longest_side(to), 1e-12)), grid(tree, spacing) {
        const Box box = bounds(to);
        rounding = 1e-10 * (norm(box.min) + norm(box.max));
    }

    int steps(double length) const {
        constexpr double max_steps = 200;
        return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, max_steps));
    }
};

// The largest distance of the samples added, or `mm` if none is larger.
class LargestDistance {
 public:
    LargestDistance(const Surface& to, double mm) : to_(to), mm_(mm) {}

    // The samples of a face but its corners; those of a side are added by the one of its two faces in which it runs
    // from the lower point to the higher. The distance to a triangle is convex: if all corners are near to one
    // triangle, all samples are, and the one near to the middle is tried.
    void add_face(const TriangleMesh& from, std::size_t triangle) {
        const TriangleCorners p = corners_of(from, triangle);
        add((1.0 / 3) * (p[0] + p[1] + p[2]));
        const int n = to_.steps(longest_side(p));
        if (n == 1 || is_covered_by(p, last_)) return;  // one step has no other samples
        const Triangle& v = from.triangles[triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            if (v[k] < v[(k + 1) % 3]) add_side(p[k], p[(k + 1) % 3]);
        }
        const Vec3 u = (1.0 / n) * (p[1] - p[0]);
        const Vec3 w = (1.0 / n) * (p[2] - p[0]);
        for (int i = 0; i < n; ++i) {
            for (int k = 0; i + k < n; ++k) {
                const Vec3 at = p[0] + static_cast<double>(i) * u + static_cast<double>(k) * w;
                if (i > 0 && k > 0) add(at);
                add(at + (1.0 / 3) * (u + w));
            }
        }
    }

    void add(Vec3 p) {
        const FloatBox at = to_.tree.box_of({p, p, p});
        if (is_near(p, at, last_)) return;
        for (const std::uint32_t place : to_.grid.places_at(at.min)) {
            if (is_near(p, at, place)) {
                last_ = place;
                return;
            }
        }
        mm_ = std::max(mm_, to_.tree.nearest(to_.mesh, p, mm_).distance);
    }

    double mm() const { return mm_; }

 private:
    void add_side(Vec3 a, Vec3 b) {
        const int n = to_.steps(norm(b - a));
        for (int i = 1; i < n; ++i) add(a + (static_cast<double>(i) / n) * (b - a));
    }

    double squared_distance(Vec3 p, std::uint32_t place) const {
        const Vec3 away = closest_on_triangle(p, corners_of(to_.mesh, to_.tree.order[place])) - p;
        return dot(away, away);
    }

    // Whether the box of a triangle is that near, and it is itself. The first is cheap, and allowed to say yes too
    // often.
    bool is_near(Vec3 p, const FloatBox& at, std::uint32_t place) const {
        const auto by = static_cast<float>(mm_);
        const FloatBox& box = to_.tree.of_triangle[place];
        int is_out = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            is_out |= int{at.min[axis] + by < box.min[axis]} | int{at.min[axis] - by > box.max[axis]};
        }
        return is_out == 0 && squared_distance(p, place) <= mm_ * mm_;
    }

    bool is_covered_by(const TriangleCorners& face, std::uint32_t place) const {
        const double limit = mm_ - to_.rounding;
        if (limit <= 0) return false;
        return std::all_of(face.begin(), face.end(),
                           [&](Vec3 p) { return squared_distance(p, place) <= limit * limit; });
    }

    const Surface& to_;
    double mm_ = 0;
    std::uint32_t last_ = 0;  // the place of the triangle that was near to the last sample
};

std::vector<std::uint8_t> points_beside_caps(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> is_used(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        for (const std::uint32_t point : mesh.triangles[t]) is_used[point] = 1;
    }
    return is_used;
}

}  // namespace

double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context) {
    constexpr std::size_t at_once = 4096;
    constexpr std::size_t first_faces = 64;
    const Surface surface(to);
    std::atomic<double> farthest_mm{0};
    const auto add_all = [&](const auto& add_samples) {
        context.check_cancelled();
        LargestDistance largest(surface, farthest_mm.load());
        add_samples(largest);
        double before = farthest_mm.load();
        while (before < largest.mm() && !farthest_mm.compare_exchange_weak(before, largest.mm())) {
        }
    };
    const auto add_faces = [&](std::size_t first, std::size_t end, std::size_t stride) {
        add_all([&](LargestDistance& largest) {
            for (std::size_t t = first; t < end; t += stride) {
                if (cap_of(from, t) == no_cap) largest.add_face(from, t);
            }
        });
    };
    // Some faces first: the larger the distance that is known, the less is searched for.
    add_faces(0, from.triangles.size(), from.triangles.size() / first_faces + 1);
    parallel_ranges(0, from.triangles.size(), at_once,
                    [&](std::size_t first, std::size_t end) { add_faces(first, end, 1); });
    const std::vector<std::uint8_t> is_used = points_beside_caps(from);
    parallel_ranges(0, from.points.size(), at_once, [&](std::size_t first, std::size_t end) {
        add_all([&](LargestDistance& largest) {
            for (std::size_t p = first; p < end; ++p) {
                if (is_used[p] != 0) largest.add(from.points[p]);
            }
        });
    });
    return farthest_mm.load();
}

}  // namespace qchopper
