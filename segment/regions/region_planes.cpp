// Sums over edges (engines/moments.h); O(edges log edges + planes^2).

#include "segment/regions/region_planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/units.h"
#include "segment/regions/borders.h"
#include "segment/regions/engines/moments.h"

namespace qchopper {
namespace {

constexpr double left_out = 0.1;
constexpr double line_ratio = 0.05;  // of the spread across a line to that along it
constexpr double equal_turn = 0.5 * degree;
constexpr double equal_share = 0.005;  // of the diagonal

using Border = std::vector<std::uint32_t>;  // dual edges

struct Fitted {
    Plane plane;
    Vec3 centre;
    double length = 0;
};

PointMoments moments_of(const FaceGraph& graph, const Border& border) {
    PointMoments moments;
    for (const std::uint32_t e : border) {
        const auto [a, b] = graph.edges[e].point;
        moments.add_edge(graph.mesh->points[a], graph.mesh->points[b]);
    }
    return moments;
}

// Nothing: the points lie nearly on a line.
std::optional<Plane> plane_through(const PointMoments& moments) {
    const PrincipalAxes axes = principal_axes(moments.covariance());
    if (axes.square[1] <= line_ratio * line_ratio * axes.square[2]) return std::nullopt;
    return canonical({axes.direction[0], dot(axes.direction[0], moments.centre())});
}

// Without the edges farthest from the plane, that have a tenth of the length together.
Border without_farthest(const FaceGraph& graph, Border border, const Plane& plane, double length) {
    const auto distance = [&](std::uint32_t e) {
        const auto [a, b] = graph.edges[e].point;
        return std::abs(height(plane.normal, 0.5 * (graph.mesh->points[a] + graph.mesh->points[b])) - plane.offset);
    };
    std::ranges::stable_sort(border, std::ranges::greater(), distance);
    double left = left_out * length;
    std::size_t first = 0;
    while (first < border.size() && left >= graph.edges[border[first]].length)
        left -= graph.edges[border[first++]].length;
    border.erase(border.begin(), border.begin() + static_cast<std::ptrdiff_t>(first));
    return border;
}

std::optional<Fitted> fitted(const FaceGraph& graph, const Border& border) {
    const PointMoments all = moments_of(graph, border);
    const std::optional<Plane> first = plane_through(all);
    if (!first) return std::nullopt;
    const PointMoments kept = moments_of(graph, without_farthest(graph, border, *first, all.weight));
    const std::optional<Plane> plane = plane_through(kept);
    if (!plane) return std::nullopt;
    return Fitted{*plane, kept.centre(), all.weight};
}

std::vector<Border> borders_of(const FaceGraph& graph, const Labels& labels) {
    std::vector<Border> whole(labels.count);
    std::vector<Border> borders;
    for (RegionBorder& part : region_borders(graph, labels.of)) {
        for (const std::uint32_t r : part.region) whole[r].insert(whole[r].end(), part.edges.begin(), part.edges.end());
        borders.push_back(std::move(part.edges));
    }
    borders.insert(borders.end(), whole.begin(), whole.end());
    return borders;
}

// Their normals are within 0.5 degrees, and each centre is near the other plane.
bool are_equal(const Fitted& a, const Fitted& b, double near) {
    if (std::abs(dot(a.plane.normal, b.plane.normal)) < std::cos(equal_turn)) return false;
    return std::abs(height(a.plane.normal, b.centre) - a.plane.offset) <= near &&
           std::abs(height(b.plane.normal, a.centre) - b.plane.offset) <= near;
}

}  // namespace

RegionPlanes region_planes(const FaceGraph& graph, const Labels& labels) {
    RegionPlanes found;
    std::vector<Fitted> all;
    for (const Border& border : borders_of(graph, labels)) {
        const double length = std::accumulate(border.begin(), border.end(), 0.0,
                                              [&](double sum, std::uint32_t e) { return sum + graph.edges[e].length; });
        if (length <= min_border_share * graph.diagonal) continue;
        if (const std::optional<Fitted> plane = fitted(graph, border)) {
            all.push_back(*plane);
        } else {
            ++found.straight;
        }
    }
    std::ranges::stable_sort(all, std::ranges::greater(), &Fitted::length);
    std::vector<Fitted> kept;
    for (const Fitted& plane : all) {
        const auto is_equal = [&](const Fitted& other) {
            return are_equal(plane, other, equal_share * graph.diagonal);
        };
        if (std::ranges::any_of(kept, is_equal)) {
            ++found.equal;
        } else if (kept.size() == max_region_planes) {
            ++found.beyond;
        } else {
            kept.push_back(plane);
        }
    }
    for (const Fitted& plane : kept) found.planes.push_back({plane.plane, plane.length});
    return found;
}

}  // namespace qchopper
