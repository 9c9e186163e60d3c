// Points, loops and predicates in a plane.
//
// Plane coordinates, mm. The predicates are plain double arithmetic, not exact: callers allow for rounding. O(1) each,
// signed_area and is_inside O(points of the loop) (tests/segment/cut/cap_test.cpp).

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace qchopper {

struct Point2 {
    double x = 0;
    double y = 0;
    bool operator==(const Point2&) const = default;
};

// Indices of points in order, counter-clockwise around material and clockwise around holes.
using Loop = std::vector<std::uint32_t>;

// An axis-parallel rectangle; a new one is empty.
struct Rectangle2 {
    Point2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Point2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    void include(Point2 p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y)};
    }
    bool is_near(Point2 p, double reach) const {
        return p.x >= min.x - reach && p.x <= max.x + reach && p.y >= min.y - reach && p.y <= max.y + reach;
    }
};

// Twice the signed area of a triangle: positive when it runs counter-clockwise.
inline double orientation(Point2 a, Point2 b, Point2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether the ray from p along x crosses the edge. Half-open in y, so that a loop is crossed once at a corner
// (M. Shimrat, "Algorithm 112: position of point relative to polygon", 1962).
inline bool ray_crosses(Point2 p, Point2 a, Point2 b) {
    return (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x;
}

// Whether p is within `reach` of the line through a and b and of the rectangle around them.
bool is_on_segment(Point2 p, Point2 a, Point2 b, double reach);

// Signed area by the shoelace formula: positive counter-clockwise.
double signed_area(std::span<const Point2> points, const Loop& loop);

// Whether the point is inside the loop, by the even-odd rule. For a point on the loop either may be returned.
bool is_inside(std::span<const Point2> points, const Loop& loop, Point2 p);

// Edges by the parallel rows of a plane that they pass, as many rows as edges: finds the edges at a position across the
// rows without a search. Precondition of at(): the number of edges given was not 0.
class EdgeRows {
 public:
    EdgeRows() = default;
    EdgeRows(double low, double high, std::size_t edges)
        : low_(low), per_mm_(high > low ? static_cast<double>(edges) / (high - low) : 0), rows_(edges) {}
    // The edge lies between these two positions.
    void add(double low, double high, std::uint32_t edge) {
        for (std::size_t r = row(low); r <= row(high); ++r) rows_[r].push_back(edge);
    }
    const std::vector<std::uint32_t>& at(double position) const { return rows_[row(position)]; }

 private:
    std::size_t row(double position) const {
        const double r = (position - low_) * per_mm_;
        return r <= 0 ? 0 : std::min(static_cast<std::size_t>(r), rows_.size() - 1);
    }

    double low_ = 0;
    double per_mm_ = 0;
    std::vector<std::vector<std::uint32_t>> rows_;
};

}  // namespace qchopper
