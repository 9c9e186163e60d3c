// Heights of the points near any wanted offset are sorted once for all offsets of a normal; the gaps between them in
// the window of an offset are compared by width, cap area, distance and order. O(points log offsets) for a normal, and
// O(triangles) for each gap that is as wide as the widest of its window.

#include "segment/cut/nudge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr double window_share = 1e-7;  // of the extent
constexpr double min_ulps = 64;
constexpr double equal_share = 1e-9;  // of the extent: an offset that is this close to a vertex counts as on it

struct Gap {
    double low;
    double high;
    double width() const { return high - low; }
    double middle() const { return low + (high - low) / 2; }
};

// The data that all offsets of one normal share.
struct Heights {
    const Piece& piece;
    Vec3 normal;
    std::vector<double> sorted_near;  // heights within the widest window of any wanted offset
    std::vector<double> of_point;     // one per point of the mesh
    Extent range;
    double min_width = 0;
};

std::vector<Gap> gaps(const Heights& heights, double low, double high) {
    std::vector<Gap> result;
    const auto begin = std::lower_bound(heights.sorted_near.begin(), heights.sorted_near.end(), low);
    const auto end = std::upper_bound(begin, heights.sorted_near.end(), high);
    double from = low;
    for (auto it = begin; it != end; ++it) {
        if (*it > from) result.push_back({from, *it});
        from = *it;
    }
    if (high > from) result.push_back({from, high});
    return result;
}

// How much larger the cap is just below `low` than just above `high`, by the faces that lie between the two: upwards
// the section loses those that face up and gains those that face down.
double flat_area(const Heights& heights, double low, double high) {
    double area = 0;
    const TriangleMesh& mesh = *heights.piece.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const bool is_between = std::all_of(v.begin(), v.end(), [&](std::uint32_t p) {
            return heights.of_point[p] >= low && heights.of_point[p] <= high;
        });
        if (is_between) area += dot(area_vector(mesh, t), heights.normal);
    }
    return area;
}

// Widths that differ by no more than this are equal. A vertex at a distance from the wanted offset makes the gap on one
// of its sides narrower by that distance and the gap on the other side wider, so the widths differ by twice as much.
double equal_width(const Heights& heights, double wanted) {
    const double near = equal_share * heights.range.size();
    const auto next = std::lower_bound(heights.sorted_near.begin(), heights.sorted_near.end(), wanted - near);
    const bool is_on_vertex = next != heights.sorted_near.end() && *next <= wanted + near;
    return std::max(heights.min_width, is_on_vertex ? 2 * near + heights.min_width : near);
}

Gap best_gap(const Heights& heights, const std::vector<Gap>& all, double wanted) {
    double widest = 0;
    for (const Gap& gap : all) widest = std::max(widest, gap.width());
    const double least = std::max(widest - equal_width(heights, wanted), std::min(widest, heights.min_width));
    std::vector<Gap> tied;
    for (const Gap& gap : all) {
        if (gap.width() >= least) tied.push_back(gap);
    }
    // Cap areas relative to that of the lowest gap; areas that differ only by rounding count as equal.
    std::vector<double> cap(tied.size(), 0);
    const double scale = heights.range.size() * heights.range.size();
    for (std::size_t i = 1; i < tied.size(); ++i) {
        cap[i] = cap[i - 1] - flat_area(heights, tied[i - 1].high, tied[i].low);
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i < tied.size(); ++i) {
        const double smaller_by = cap[best] - cap[i];
        const double nearer_by = std::abs(tied[best].middle() - wanted) - std::abs(tied[i].middle() - wanted);
        const bool is_equal = std::abs(smaller_by) <= 1e-12 * scale;
        if (is_equal ? nearer_by > heights.min_width : smaller_by > 0) best = i;
    }
    return tied[best];
}

bool is_near_parallel_half_space(const Piece& piece, Vec3 normal, double wanted, double window) {
    return std::any_of(piece.half_spaces.begin(), piece.half_spaces.end(), [&](const HalfSpace& half_space) {
        const double along = dot(half_space.plane.normal, normal);
        return std::abs(along) > 1 - 1e-12 &&
               std::abs(half_space.plane.offset * (along > 0 ? 1 : -1) - wanted) <= window;
    });
}

std::optional<Nudged> nudge_one(const Heights& heights, double wanted) {
    const double window = window_share * heights.range.size();
    if (!(wanted > heights.range.low + window && wanted < heights.range.high - window)) return std::nullopt;
    if (is_near_parallel_half_space(heights.piece, heights.normal, wanted, window)) return std::nullopt;
    for (const double factor : {1.0, 10.0}) {
        const double low = std::max(wanted - factor * window, heights.range.low);
        const double high = std::min(wanted + factor * window, heights.range.high);
        const std::vector<Gap> all = gaps(heights, low, high);
        if (all.empty()) continue;
        const Gap gap = best_gap(heights, all, wanted);
        if (gap.width() >= heights.min_width) return Nudged{gap.middle(), factor > 1};
    }
    return std::nullopt;
}

}  // namespace

Extent extent(const TriangleMesh& mesh, Vec3 normal) {
    Extent range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vec3& p : mesh.points) {
        const double h = height(normal, p);
        range.low = std::min(range.low, h);
        range.high = std::max(range.high, h);
    }
    return range;
}

std::vector<std::optional<Nudged>> nudge(const Piece& piece, Vec3 normal, std::span<const double> wanted) {
    const TriangleMesh& mesh = *piece.mesh;
    Heights heights{piece, normal, {}, {}, extent(mesh, normal), 0};
    const double largest = std::max(std::abs(heights.range.low), std::abs(heights.range.high));
    heights.min_width = min_ulps * (std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest);
    std::vector<double> sorted_wanted(wanted.begin(), wanted.end());
    std::sort(sorted_wanted.begin(), sorted_wanted.end());
    const double reach = 10 * window_share * heights.range.size();
    heights.of_point.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        const double h = height(normal, p);
        heights.of_point.push_back(h);
        const auto next = std::lower_bound(sorted_wanted.begin(), sorted_wanted.end(), h - reach);
        if (next != sorted_wanted.end() && *next <= h + reach) heights.sorted_near.push_back(h);
    }
    std::sort(heights.sorted_near.begin(), heights.sorted_near.end());
    std::vector<std::optional<Nudged>> result;
    result.reserve(wanted.size());
    for (const double offset : wanted) result.push_back(nudge_one(heights, offset));
    return result;
}

}  // namespace qchopper
