// A loop lies where any of its points lies that is not on the other loop: inside it or outside, by the crossing number
// (polygon.h). Pairs of loops are first sorted out by their bounding rectangles. O(L^2 + L N) for L loops of N points.

#include "segment/mesh/polygon_nesting.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace qchopper {
namespace {

// Loops that touch have points within this share of the section's size of each other; only rounding moves them.
constexpr double touch_share = 1e-9;

bool is_on(std::span<const Point2> points, const Loop& loop, Point2 p, double reach) {
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        if (is_on_segment(p, points[loop[i]], points[loop[j]], reach)) return true;
    }
    return false;
}

// Tests many points for whether they are on a loop, by its edges in rows. The rows are oblique, because the sides of
// constructed shapes run along the axes.
class PolygonOutline {
 public:
    PolygonOutline(std::span<const Point2> points, const Loop& loop, double reach)
        : points_(points), loop_(loop), reach_(reach) {
        const auto [low, high] = std::minmax_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
            return across(points[a]) < across(points[b]);
        });
        rows_ = EdgeRows(across(points[*low]), across(points[*high]), loop.size());
        for (std::uint32_t i = 0; i < loop.size(); ++i) {
            const auto [from, to] = std::minmax({across(points[loop[i]]), across(points[loop[next(i)]])});
            rows_.add(from - 2 * reach, to + 2 * reach, i);
        }
    }
    bool contains(Point2 p) const {
        const std::vector<std::uint32_t>& edges = rows_.at(across(p));
        return std::any_of(edges.begin(), edges.end(), [&](std::uint32_t i) {
            return is_on_segment(p, points_[loop_[i]], points_[loop_[next(i)]], reach_);
        });
    }

 private:
    static double across(Point2 p) { return 0.62 * p.x + 0.78 * p.y; }
    std::size_t next(std::size_t i) const { return i + 1 < loop_.size() ? i + 1 : 0; }

    std::span<const Point2> points_;
    const Loop& loop_;
    double reach_;
    EdgeRows rows_;
};

// A point far inside the loop: in the widest gap between the heights of its points, in the middle of the widest segment
// there. Nothing if that is not wider than `reach`.
std::optional<Point2> interior_point(std::span<const Point2> points, const Loop& loop, double reach) {
    std::vector<double> heights;
    for (const std::uint32_t p : loop) heights.push_back(points[p].y);
    std::sort(heights.begin(), heights.end());
    std::size_t widest = 1;
    for (std::size_t i = 2; i < heights.size(); ++i) {
        if (heights[i] - heights[i - 1] > heights[widest] - heights[widest - 1]) widest = i;
    }
    const double y = heights[widest - 1] + (heights[widest] - heights[widest - 1]) / 2;
    std::vector<double> crossings;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Point2 a = points[loop[i]];
        const Point2 b = points[loop[j]];
        if ((a.y > y) != (b.y > y)) crossings.push_back((b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x);
    }
    std::sort(crossings.begin(), crossings.end());
    Point2 best;
    double breadth = 0;
    for (std::size_t i = 1; i < crossings.size(); i += 2) {
        if (crossings[i] - crossings[i - 1] <= breadth) continue;
        breadth = crossings[i] - crossings[i - 1];
        best = {crossings[i - 1] + breadth / 2, y};
    }
    if (breadth <= reach) return std::nullopt;
    return best;
}

enum class Containment { outside, inside, same };

// Where a loop lies that does not cross the other one, by the first of its points that is not on the other loop, almost
// always the first of all; else by the middle of an edge that is not; else by a point inside it.
Containment containment(std::span<const Point2> points, const Loop& loop, const Loop& other, double reach) {
    const auto by_point = [&](Point2 p) {
        return is_inside(points, other, p) ? Containment::inside : Containment::outside;
    };
    if (!is_on(points, other, points[loop.front()], reach)) return by_point(points[loop.front()]);
    const PolygonOutline outline(points, other, reach);
    for (const std::uint32_t p : loop) {
        if (!outline.contains(points[p])) return by_point(points[p]);
    }
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const Point2 a = points[loop[i]];
        const Point2 b = points[loop[j]];
        const Point2 middle{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
        if (!outline.contains(middle)) return by_point(middle);
    }
    const std::optional<Point2> within = interior_point(points, loop, reach);
    if (!within || !is_inside(points, other, *within)) return Containment::outside;
    const PolygonOutline own(points, loop, reach);
    const bool is_same =
        std::all_of(other.begin(), other.end(), [&](std::uint32_t p) { return own.contains(points[p]); });
    return is_same ? Containment::same : Containment::inside;
}

// One list per loop: the loops around it. Loops with the same outline (a solid that fills a cavity) are nested in an
// order in which the orientation of each fits its depth, as far as there is one.
std::vector<std::vector<std::size_t>> loops_around(std::span<const Point2> points, std::span<const Loop> loops,
                                                   std::span<const double> area) {
    const std::size_t count = loops.size();
    std::vector<Rectangle2> box(count);
    Rectangle2 all;
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::uint32_t p : loops[i]) box[i].include(points[p]);
        all.include(box[i].min);
        all.include(box[i].max);
    }
    const double reach = touch_share * std::hypot(all.max.x - all.min.x, all.max.y - all.min.y);
    std::vector<std::vector<std::size_t>> around(count);
    std::vector<std::vector<std::size_t>> same(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            if (j == i || !box[j].is_near(points[loops[i].front()], reach)) continue;
            const Containment where = containment(points, loops[i], loops[j], reach);
            if (where == Containment::inside) around[i].push_back(j);
            if (where == Containment::same) same[i].push_back(j);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (same[i].empty() || same[i].front() < i) continue;
        std::vector<std::size_t> rest{i};
        rest.insert(rest.end(), same[i].begin(), same[i].end());
        std::vector<std::size_t> nested;
        while (!rest.empty()) {
            const bool is_material = (around[i].size() + nested.size()) % 2 == 0;
            auto next =
                std::find_if(rest.begin(), rest.end(), [&](std::size_t k) { return (area[k] >= 0) == is_material; });
            if (next == rest.end()) next = rest.begin();
            nested.push_back(*next);
            rest.erase(next);
        }
        for (std::size_t k = 1; k < nested.size(); ++k) {
            around[nested[k]].insert(around[nested[k]].end(), nested.begin(),
                                     nested.begin() + static_cast<std::ptrdiff_t>(k));
        }
    }
    return around;
}

}  // namespace

std::vector<CapRegion> nest_polygons(std::span<const Point2> points, std::span<const Loop> loops) {
    const std::size_t count = loops.size();
    std::vector<double> area(count);
    for (std::size_t i = 0; i < count; ++i) area[i] = signed_area(points, loops[i]);
    const std::vector<std::vector<std::size_t>> around = loops_around(points, loops, area);
    std::vector<CapRegion> regions;
    std::vector<std::size_t> region_of(count, count);
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i].size() % 2 != 0) continue;
        region_of[i] = regions.size();
        regions.push_back({i, {}, area[i] >= 0});
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i].size() % 2 == 0) continue;
        std::size_t outer = count;
        for (const std::size_t j : around[i]) {
            const bool is_outer = region_of[j] != count;
            if (is_outer && (outer == count || std::abs(area[j]) < std::abs(area[outer]))) outer = j;
        }
        if (outer == count) {  // possible only where loops cross each other: a region of its own
            regions.push_back({i, {}, false});
            continue;
        }
        CapRegion& region = regions[region_of[outer]];
        region.holes.push_back(i);
        if (area[i] > 0) region.is_simple = false;
    }
    return regions;
}

}  // namespace qchopper
