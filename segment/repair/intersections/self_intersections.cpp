// A tree of boxes is traversed against itself. Nearly all pairs of triangles that it finds are neighbours, which a
// plane separates: that is decided in double arithmetic with a bound on the rounding error, the rest exactly
// (exact_pair.h). About O(n log n) for n triangles of a surface, O(n^2) where all boxes meet, which the limits end.

#include "segment/repair/intersections/self_intersections.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/repair/intersections/exact_pair.h"

namespace qchopper {
namespace {

// Bounds on the relative rounding error of a dot product (2.2e-16 x 3) and of a determinant of differences, with a
// margin.
constexpr double dot_error = 4e-15;
constexpr double determinant_error = 2e-14;
// Products below this lose digits by underflow.
constexpr double smallest = 1e-280;

double sum_of(Vec3 a) {
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

// The sign of a.b for differences of exact points; 0 where rounding may decide.
int sure_sign(Vec3 a, Vec3 b) {
    const double value = dot(a, b);
    const double bound = dot_error * (std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z)) + smallest;
    return value > bound ? 1 : value < -bound ? -1 : 0;
}

// The sign of n.p where n is the computed cross product of a and b; 0 where rounding may decide.
int sure_side(Vec3 n, double size_of_n, Vec3 p) {
    const double value = dot(n, p);
    const double bound = determinant_error * size_of_n * sum_of(p) + smallest;
    return value > bound ? 1 : value < -bound ? -1 : 0;
}

// Edge pq is shared: u and w lead from p to the third corners. They meet only if these lie on one side of the edge and
// in one plane.
bool are_apart_at_edge(Vec3 edge, Vec3 u, Vec3 w) {
    const Vec3 m = cross(edge, u);
    const Vec3 n = cross(edge, w);
    const double length = sum_of(edge);
    const double bound = determinant_error * length * length * sum_of(u) * sum_of(w) + smallest;
    return dot(m, n) < -bound || sure_side(m, length * sum_of(u), w) != 0;
}

// A corner is shared: a, b lead from it to the others of one triangle, c, d of the other.
bool are_apart_at_corner(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 across = (a + b) - (c + d);
    if (sure_sign(across, a) > 0 && sure_sign(across, b) > 0 && sure_sign(across, c) < 0 && sure_sign(across, d) < 0) {
        return true;
    }
    const Vec3 n = cross(a, b);
    const double size_of_n = sum_of(a) * sum_of(b);
    const int side_of_c = sure_side(n, size_of_n, c);
    if (side_of_c != 0 && side_of_c == sure_side(n, size_of_n, d)) return true;
    const Vec3 m = cross(c, d);
    const double size_of_m = sum_of(c) * sum_of(d);
    const int side_of_a = sure_side(m, size_of_m, a);
    return side_of_a != 0 && side_of_a == sure_side(m, size_of_m, b);
}

// All corners of b on one side of the plane of a.
bool is_beside_plane(const Corners& a, const Corners& b) {
    const Vec3 u = a[1] - a[0];
    const Vec3 w = a[2] - a[0];
    const Vec3 n = cross(u, w);
    const double size_of_n = sum_of(u) * sum_of(w);
    const int side = sure_side(n, size_of_n, b[0] - a[0]);
    return side != 0 && side == sure_side(n, size_of_n, b[1] - a[0]) && side == sure_side(n, size_of_n, b[2] - a[0]);
}

// All of b beyond all of a in this direction.
bool is_beyond(Vec3 direction, const Corners& a, const Corners& b) {
    for (const Vec3& from : a) {
        for (const Vec3& to : b) {
            if (sure_sign(direction, to - from) <= 0) return false;
        }
    }
    return true;
}

bool are_apart(const Corners& a, const Corners& b) {
    return is_beside_plane(a, b) || is_beside_plane(b, a) ||
           is_beyond((b[0] - a[0]) + (b[1] - a[1]) + (b[2] - a[2]), a, b);
}

// So many subtrees are searched before the limits are checked; each may reach its share of them.
constexpr std::size_t per_wave = 16;

// One search for all pairs.
class Searching {
 public:
    Searching(const TriangleMesh& mesh, const SelfIntersectionOptions& options)
        : mesh_(mesh), options_(options), tree_(mesh) {}

    SelfIntersections search(const Context& context) {
        SelfIntersections result;
        if (tree_.leaves == 0) return result;
        find_without_area(result);
        // Subtrees of one level against each other, in waves, so that the end at a limit does not depend on the
        // threads.
        const std::size_t subtrees = std::min<std::size_t>(tree_.leaves, 1024);
        std::size_t comparisons = 0;
        for (std::size_t begin = 0; begin < subtrees && result.is_complete; begin += per_wave) {
            context.check_cancelled();
            const std::size_t end = std::min(subtrees, begin + per_wave);
            std::vector<Task> wave(end - begin);
            parallel_for(begin, end, [&](std::size_t i) { search_from(subtrees, i, wave[i - begin]); });
            for (Task& task : wave) {
                comparisons += task.comparisons;
                result.pairs.insert(result.pairs.end(), task.pairs.begin(), task.pairs.end());
                result.is_complete &= !task.is_over;
            }
            if (end < subtrees &&
                (comparisons > options_.max_comparisons || result.pairs.size() > options_.max_pairs)) {
                result.is_complete = false;
            }
            context.progress("places searched for self-intersections", end, subtrees);
        }
        std::sort(result.pairs.begin(), result.pairs.end());
        return result;
    }

 private:
    struct Task {
        std::vector<std::array<std::uint32_t, 2>> pairs;
        std::size_t comparisons = 0;
        bool is_over = false;  // it has reached its share of a limit
    };

    void find_without_area(SelfIntersections& result) {
        is_flat_.assign(mesh_.triangles.size(), 0);
        parallel_for(0, tree_.leaves, [&](std::size_t leaf) {
            const std::size_t end = std::min(tree_.order.size(), (leaf + 1) * TriangleTree::per_leaf);
            for (std::size_t place = leaf * TriangleTree::per_leaf; place < end; ++place) {
                const std::uint32_t t = tree_.order[place];
                const Corners c = corners_of(mesh_, t);
                const Vec3 u = c[1] - c[0];
                const Vec3 w = c[2] - c[0];
                const bool is_surely_fine = sum_of(cross(u, w)) > determinant_error * sum_of(u) * sum_of(w) + smallest;
                is_flat_[t] = !is_surely_fine && !has_area(c);
            }
        });
        for (std::uint32_t t = 0; t < is_flat_.size(); ++t) {
            if (is_flat_[t]) result.without_area.push_back(t);
        }
    }

    // One subtree against itself and those after it.
    void search_from(std::size_t subtrees, std::size_t i, Task& task) const {
        within(subtrees + i, task);
        for (std::size_t j = i + 1; j < subtrees; ++j) between(subtrees + i, subtrees + j, task);
    }

    void within(std::size_t node, Task& task) const {
        if (task.is_over) return;
        if (node < tree_.leaves) {
            within(2 * node, task);
            within(2 * node + 1, task);
            between(2 * node, 2 * node + 1, task);
            return;
        }
        const auto [begin, end] = places(node);
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t j = i + 1; j < end; ++j) compare(i, j, task);
        }
    }

    // Two nodes of one level.
    void between(std::size_t a, std::size_t b, Task& task) const {
        ++task.comparisons;
        task.is_over |=
            task.pairs.size() > options_.max_pairs / per_wave || task.comparisons > options_.max_comparisons / per_wave;
        if (task.is_over || !do_meet(tree_.of_node[a], tree_.of_node[b])) return;
        if (a < tree_.leaves) {
            between(2 * a, 2 * b, task);
            between(2 * a, 2 * b + 1, task);
            between(2 * a + 1, 2 * b, task);
            between(2 * a + 1, 2 * b + 1, task);
            return;
        }
        const auto [begin_a, end_a] = places(a);
        const auto [begin_b, end_b] = places(b);
        for (std::size_t i = begin_a; i < end_a; ++i) {
            if (!do_meet(tree_.of_triangle[i], tree_.of_node[b])) continue;
            for (std::size_t j = begin_b; j < end_b; ++j) compare(i, j, task);
        }
        task.comparisons += TriangleTree::per_leaf * TriangleTree::per_leaf;
    }

    std::pair<std::size_t, std::size_t> places(std::size_t leaf_node) const {
        const std::size_t begin = (leaf_node - tree_.leaves) * TriangleTree::per_leaf;
        return {std::min(begin, tree_.order.size()), std::min(begin + TriangleTree::per_leaf, tree_.order.size())};
    }

    void compare(std::size_t i, std::size_t j, Task& task) const {
        if (!do_meet(tree_.of_triangle[i], tree_.of_triangle[j])) return;
        const std::uint32_t a = tree_.order[i];
        const std::uint32_t b = tree_.order[j];
        if (are_surely_apart(mesh_.triangles[a], mesh_.triangles[b])) return;
        if (is_flat_[a] || is_flat_[b]) return;
        if (do_meet(corners_of(mesh_, a), corners_of(mesh_, b))) task.pairs.push_back({std::min(a, b), std::max(a, b)});
    }

    bool are_surely_apart(const Triangle& a, const Triangle& b) const {
        unsigned in_a = 0;  // which corners of a are corners of b
        unsigned in_b = 0;
        for (unsigned k = 0; k < 3; ++k) {
            for (unsigned l = 0; l < 3; ++l) {
                const unsigned is_same = a[k] == b[l] ? 1U : 0U;
                in_a |= is_same << k;
                in_b |= is_same << l;
            }
        }
        const auto point = [&](std::uint32_t v) -> const Vec3& { return mesh_.points[v]; };
        switch (std::popcount(in_a)) {
            case 0:
                return are_apart({point(a[0]), point(a[1]), point(a[2])}, {point(b[0]), point(b[1]), point(b[2])});
            case 1: {
                const unsigned k = static_cast<unsigned>(std::countr_zero(in_a));
                const unsigned l = static_cast<unsigned>(std::countr_zero(in_b));
                const Vec3 o = point(a[k]);
                return are_apart_at_corner(point(a[(k + 1) % 3]) - o, point(a[(k + 2) % 3]) - o,
                                           point(b[(l + 1) % 3]) - o, point(b[(l + 2) % 3]) - o);
            }
            case 2: {
                const unsigned k = static_cast<unsigned>(std::countr_zero(~in_a));  // the corner that is not shared
                const unsigned l = static_cast<unsigned>(std::countr_zero(~in_b));
                const Vec3 p = point(a[(k + 1) % 3]);
                return are_apart_at_edge(point(a[(k + 2) % 3]) - p, point(a[k]) - p, point(b[l]) - p);
            }
            default:
                return false;
        }
    }

    const TriangleMesh& mesh_;
    const SelfIntersectionOptions& options_;
    const TriangleTree tree_;
    std::vector<std::uint8_t> is_flat_;  // per triangle: without area
};

}  // namespace

SelfIntersections self_intersections(const TriangleMesh& mesh, const SelfIntersectionOptions& options,
                                     const Context& context) {
    return Searching(mesh, options).search(context);
}

Vec3 meeting_place(const TriangleMesh& mesh, const std::array<std::uint32_t, 2>& pair) {
    Vec3 place;
    const Corners a = corners_of(mesh, pair[0]);
    const Corners b = corners_of(mesh, pair[1]);
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low_a, high_a] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
        const auto [low_b, high_b] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
        place[axis] = 0.5 * std::max(low_a, low_b) + 0.5 * std::min(high_a, high_b);
    }
    return place;
}

}  // namespace qchopper
