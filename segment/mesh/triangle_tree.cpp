// Triangles sorted along a Morton curve, and a complete binary tree over them, after C. Lauterbach, M. Garland,
// S. Sengupta, D. Luebke and D. Manocha, "Fast BVH construction on GPUs" (2009). Built in O(triangles); the result does
// not depend on the number of threads. The closest point of a triangle after C. Ericson, "Real-Time Collision
// Detection" (2005), 5.1.5.

#include "segment/mesh/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr std::size_t block = 4096;

template <class Work>
void in_blocks(std::size_t count, const Work& work) {
    parallel_ranges(0, count, block, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) work(i);
    });
}

// Spreads the low 10 bits so that two zeros follow each.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000FF;
    x = (x | x << 8) & 0x0300F00F;
    x = (x | x << 4) & 0x030C30C3;
    x = (x | x << 2) & 0x09249249;
    return x;
}

// Radix sort by the upper 32 bits, of which only 30 are in use; ties keep their order.
void sort_by_code(std::vector<std::uint64_t>& keyed) {
    constexpr int digit = 10;
    std::vector<std::uint64_t> other(keyed.size());
    for (int shift = 32; shift < 62; shift += digit) {
        std::array<std::size_t, 1U << digit> place{};
        const auto digit_of = [&](std::uint64_t k) { return (k >> shift) & ((1U << digit) - 1); };
        for (const std::uint64_t k : keyed) ++place[digit_of(k)];
        std::size_t sum = 0;
        for (std::size_t& p : place) sum += std::exchange(p, sum);
        for (const std::uint64_t k : keyed) other[place[digit_of(k)]++] = k;
        keyed.swap(other);
    }
}

// Triangles by the place of their middle along the Morton curve.
std::vector<std::uint32_t> along_curve(const TriangleMesh& mesh, const Box& box) {
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double scale = longest > 0 && std::isfinite(longest) ? 1023.0 / longest : 0;
    std::vector<std::uint64_t> keyed(mesh.triangles.size());
    in_blocks(keyed.size(), [&](std::size_t t) {
        const Triangle& v = mesh.triangles[t];
        std::uint32_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double middle =
                ((mesh.points[v[0]][axis] - box.min[axis]) + (mesh.points[v[1]][axis] - box.min[axis]) +
                 (mesh.points[v[2]][axis] - box.min[axis])) /
                3;
            code |= spread(std::min(static_cast<std::uint32_t>(scale * middle), 1023U)) << axis;
        }
        keyed[t] = std::uint64_t{code} << 32 | t;
    });
    sort_by_code(keyed);
    std::vector<std::uint32_t> order(keyed.size());
    in_blocks(order.size(), [&](std::size_t i) { order[i] = static_cast<std::uint32_t>(keyed[i]); });
    return order;
}

void grow(FloatBox& box, const FloatBox& by) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::min(box.min[axis], by.min[axis]);
        box.max[axis] = std::max(box.max[axis], by.max[axis]);
    }
}

// Squared distance from a point to a box, in the tree's coordinates; a little less than the true one. Infinite for an
// empty box: up to half of the leaves are empty, and none of them is to be entered.
double squared_distance(const FloatBox& box, Vec3 p) {
    if (box.min[0] > box.max[0]) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double low = box.min[a];
        const double high = box.max[a];
        // the rounding error of a float
        const double slack = 2.5e-7 * std::max(std::abs(low), std::abs(high));
        const double out = std::max({0.0, low - slack - p[axis], p[axis] - high - slack});
        sum += out * out;
    }
    return sum;
}

// The same in single precision, for many boxes: its error is for the caller to allow for.
float squared_distance(const FloatBox& box, const std::array<float, 3>& p) {
    float sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float out = std::max(std::max(box.min[axis] - p[axis], p[axis] - box.max[axis]), 0.0F);
        sum += out * out;
    }
    return sum;
}

// A squared distance that squared_distance in single precision does not reach for a box that is nearer to p than
// `distance`. Corners, p and differences are rounded by at most 6e-8 of the largest coordinate each, and the squares
// and their sum by that share of themselves.
float squared_limit(const FloatBox& all, const std::array<float, 3>& p, double distance) {
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float of_axis = std::max({std::abs(all.min[axis]), std::abs(all.max[axis]), std::abs(p[axis])});
        largest = std::max(largest, double{of_axis});
    }
    const double wider = distance + 1e-6 * (largest + distance);
    return static_cast<float>(wider * wider);
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    if (count == 0) return;
    const Box box = bounds(mesh);
    centre = box.centre();
    order = along_curve(mesh, box);
    of_triangle.resize(count);
    leaves = std::bit_ceil((count + per_leaf - 1) / per_leaf);
    of_node.resize(2 * leaves);
    in_blocks((count + per_leaf - 1) / per_leaf, [&](std::size_t leaf) {
        const std::size_t end = std::min(count, (leaf + 1) * per_leaf);
        for (std::size_t place = leaf * per_leaf; place < end; ++place) {
            of_triangle[place] = box_of(corners_of(mesh, order[place]));
            grow(of_node[leaves + leaf], of_triangle[place]);
        }
    });
    for (std::size_t level = leaves / 2; level > 0; level /= 2) {
        in_blocks(level, [&](std::size_t i) {
            const std::size_t node = level + i;
            of_node[node] = of_node[2 * node];
            grow(of_node[node], of_node[2 * node + 1]);
        });
    }
}

FloatBox TriangleTree::box_of(const std::array<Vec3, 3>& corners) const {
    FloatBox box;
    for (const Vec3& corner : corners) {
        const std::array<float, 3> at{static_cast<float>(corner.x - centre.x), static_cast<float>(corner.y - centre.y),
                                      static_cast<float>(corner.z - centre.z)};
        grow(box, {at, at});
    }
    return box;
}

TriangleTree::Nearest TriangleTree::nearest(const TriangleMesh& mesh, Vec3 p, double enough) const {
    Nearest best;
    double best_squared = std::numeric_limits<double>::infinity();
    const Vec3 at = p - centre;
    struct Open {
        std::size_t node;
        double squared;
    };
    std::array<Open, 64> stack;
    std::size_t height = 0;
    if (leaves > 0) stack[height++] = {1, 0};
    while (height > 0) {
        const auto [node, squared] = stack[--height];
        if (squared >= best_squared) continue;
        if (node >= leaves) {
            const std::size_t end = std::min(order.size(), (node - leaves + 1) * per_leaf);
            for (std::size_t place = (node - leaves) * per_leaf; place < end; ++place) {
                const Vec3 point = closest_on_triangle(p, corners_of(mesh, order[place]));
                const double d = dot(point - p, point - p);
                if (!(d < best_squared)) continue;
                best_squared = d;
                best = {std::sqrt(d), point, order[place]};
            }
            if (best.distance <= enough) return best;
            continue;
        }
        Open near{2 * node, squared_distance(of_node[2 * node], at)};
        Open far{2 * node + 1, squared_distance(of_node[2 * node + 1], at)};
        if (far.squared < near.squared) std::swap(near, far);
        if (far.squared < best_squared) stack[height++] = far;
        if (near.squared < best_squared) stack[height++] = near;
    }
    return best;
}

bool TriangleTree::is_any_nearer(const TriangleMesh& mesh, Vec3 p, double distance,
                                 const std::vector<bool>& is_left_out) const {
    if (leaves == 0) return false;
    const double limit = distance * distance;
    const std::array<float, 3> at = box_of({p, p, p}).min;
    const float box_limit = squared_limit(of_node[1], at, distance);
    std::array<std::size_t, 64> stack;
    std::size_t height = 0;
    stack[height++] = 1;
    while (height > 0) {
        const std::size_t node = stack[--height];
        if (node >= leaves) {
            const std::size_t end = std::min(order.size(), (node - leaves + 1) * per_leaf);
            for (std::size_t place = (node - leaves) * per_leaf; place < end; ++place) {
                if (squared_distance(of_triangle[place], at) > box_limit) continue;  // spares a look at its corners
                if (!is_left_out.empty() && is_left_out[order[place]]) continue;
                const Vec3 away = closest_on_triangle(p, corners_of(mesh, order[place])) - p;
                if (dot(away, away) < limit) return true;
            }
            continue;
        }
        std::size_t near = 2 * node;
        std::size_t far = 2 * node + 1;
        float to_near = squared_distance(of_node[near], at);
        float to_far = squared_distance(of_node[far], at);
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        if (to_far <= box_limit) stack[height++] = far;
        if (to_near <= box_limit) stack[height++] = near;
    }
    return false;
}

namespace {

// make(point, share of a, of b, of c): what is made of the point alone costs no shares.
template <class Make>
auto nearest_with(Vec3 p, const std::array<Vec3, 3>& triangle, const Make& make) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = dot(ab, p - a);
    const double d2 = dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return make(a, 1, 0, 0);
    const double d3 = dot(ab, p - b);
    const double d4 = dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return make(b, 0, 1, 0);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) {
        const double t = d1 / (d1 - d3);
        return make(a + t * ab, 1 - t, t, 0);
    }
    const double d5 = dot(ab, p - c);
    const double d6 = dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return make(c, 0, 0, 1);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) {
        const double t = d2 / (d2 - d6);
        return make(a + t * ac, 1 - t, 0, t);
    }
    const double va = d3 * d6 - d5 * d4;
    const double along = (d4 - d3) + (d5 - d6);
    if (va <= 0 && d4 >= d3 && d5 >= d6 && along > 0) {
        const double t = (d4 - d3) / along;
        return make(b + t * (c - b), 0, 1 - t, t);
    }
    const double sum = va + vb + vc;
    if (!(sum > 0)) return make(a, 1, 0, 0);
    return make(a + (vb / sum) * ab + (vc / sum) * ac, va / sum, vb / sum, vc / sum);
}

}  // namespace

NearestOfTriangle nearest_of_triangle(Vec3 p, const std::array<Vec3, 3>& triangle) {
    return nearest_with(p, triangle, [](Vec3 point, double a, double b, double c) {
        return NearestOfTriangle{point, {a, b, c}};
    });
}

Vec3 closest_on_triangle(Vec3 p, const std::array<Vec3, 3>& triangle) {
    return nearest_with(p, triangle, [](Vec3 point, double, double, double) { return point; });
}

}  // namespace qchopper
