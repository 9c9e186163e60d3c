// CGAL's search, after C.-T. Chang, B. Gorissen and S. Melchior, "Fast oriented bounding box optimization on the
// rotation group SO(3,R)" (2011): a hybrid of genetic search and Nelder-Mead. It gets the points that are farthest in
// 256 directions: the box of those is within a percent of the box of all, at a tenth of the time.

#include "segment/mesh/oriented_box.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "base/box.h"

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

constexpr std::size_t block = 64;        // consecutive points with one box, which is tested first
constexpr std::size_t directions = 256;  // 1024 gain 0.1 % of volume and cost four times as much
constexpr unsigned seed = 1;

struct BlockBox {
    Vec3 centre;
    Vec3 half;
};

std::vector<BlockBox> block_boxes(std::span<const Vec3> points) {
    std::vector<BlockBox> boxes;
    for (std::size_t first = 0; first < points.size(); first += block) {
        Box box{points[first], points[first]};
        for (const Vec3& p : points.subspan(first, std::min(block, points.size() - first))) extend(box, p);
        boxes.push_back({box.centre(), 0.5 * box.size()});
    }
    return boxes;
}

// The farthest point in each of many evenly spread directions (a Fibonacci spiral on the sphere).
std::vector<std::uint32_t> extreme_points(std::span<const Vec3> points) {
    const std::vector<BlockBox> boxes = block_boxes(points);
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<std::uint32_t> extreme;
    for (std::size_t i = 0; i < directions; ++i) {
        const double z = 1 - (2.0 * static_cast<double>(i) + 1) / directions;
        const double r = std::sqrt(1 - z * z);
        const double phi = golden_angle * static_cast<double>(i);
        const Vec3 d{r * std::cos(phi), r * std::sin(phi), z};
        double best = -std::numeric_limits<double>::infinity();
        std::uint32_t best_point = 0;
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const Vec3& h = boxes[b].half;
            const double reach = std::abs(d.x) * h.x + std::abs(d.y) * h.y + std::abs(d.z) * h.z;
            if (dot(d, boxes[b].centre) + reach <= best) continue;
            for (std::size_t p = b * block; p < std::min(points.size(), (b + 1) * block); ++p) {
                const double at = dot(d, points[p]);
                if (at > best) {
                    best = at;
                    best_point = static_cast<std::uint32_t>(p);
                }
            }
        }
        extreme.push_back(best_point);
    }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    return extreme;
}

Vec3 with_first_positive(Vec3 a) {
    const bool flip = a.x < 0 || (a.x == 0 && (a.y < 0 || (a.y == 0 && a.z < 0)));
    return flip ? Vec3{} - a : Vec3{} + a;
}

void set_extents(OrientedBox& box, std::span<const Vec3> points) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box extents{{far, far, far}, {-far, -far, -far}};
    for (const Vec3& p : points) extend(extents, {dot(box.axis[0], p), dot(box.axis[1], p), dot(box.axis[2], p)});
    box.min = extents.min;
    box.max = extents.max;
}

// The axes of CGAL's box, or those of the world if the points lie in a plane.
std::array<Vec3, 3> search_axes(std::span<const Vec3> points) {
    std::vector<Point> few;
    for (const std::uint32_t p : extreme_points(points)) few.emplace_back(points[p].x, points[p].y, points[p].z);
    bool is_solid = false;
    for (std::size_t i = 3; i < few.size() && !is_solid; ++i) {
        for (std::size_t j = 2; j < i && !is_solid; ++j) is_solid = !CGAL::coplanar(few[0], few[1], few[j], few[i]);
    }
    if (!is_solid) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    std::array<Point, 8> corner;
    CGAL::oriented_bounding_box(few, corner, CGAL::parameters::random_seed(seed));
    const auto edge = [&](std::size_t to) {
        return Vec3{corner[to].x() - corner[0].x(), corner[to].y() - corner[0].y(), corner[to].z() - corner[0].z()};
    };
    // CGAL's corner 0 is joined to corners 1, 3 and 5.
    return {normalized(edge(1)), normalized(edge(3)), normalized(edge(5))};
}

}  // namespace

OrientedBox oriented_box(std::span<const Vec3> points) {
    assert(!points.empty());
    OrientedBox box{search_axes(points), {}, {}};
    set_extents(box, points);
    std::array<int, 3> order{0, 1, 2};
    const Vec3 size = box.size();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
    const std::array<Vec3, 3> axis = box.axis;
    box.axis[0] = with_first_positive(axis[static_cast<std::size_t>(order[0])]);
    box.axis[1] = with_first_positive(axis[static_cast<std::size_t>(order[1])]);
    box.axis[2] = normalized(cross(box.axis[0], box.axis[1]));
    set_extents(box, points);
    assert(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
    return box;
}

}  // namespace qchopper
