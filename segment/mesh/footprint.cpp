// Hull: monotone chains (A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979),
// O(n log n). Rectangle: one side of it lies on an edge of the hull (H. Freeman and R. Shapira, "Determining the
// minimum-area encasing rectangle for an arbitrary closed curve", 1975), so one turn around the hull with four contact
// points suffices, O(hull).

#include "segment/mesh/footprint.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace qchopper {
namespace {

Point2 minus(Point2 a, Point2 b) {
    return {a.x - b.x, a.y - b.y};
}
double dot2(Point2 a, Point2 b) {
    return a.x * b.x + a.y * b.y;
}
double cross2(Point2 a, Point2 b) {
    return a.x * b.y - a.y * b.x;
}

// One turn around the hull below or above; points must be sorted.
template <class Iterator>
void add_chain(std::vector<Point2>& hull, Iterator first, Iterator last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
        while (hull.size() >= start + 2 &&
               cross2(minus(hull.back(), hull[hull.size() - 2]), minus(*first, hull.back())) <= 0) {
            hull.pop_back();
        }
        hull.push_back(*first);
    }
    hull.pop_back();  // it begins the other chain
}

// Moves a contact point on while the next corner reaches further. Never more than once around.
std::size_t advance(const std::vector<Point2>& hull, std::size_t from, Point2 direction) {
    std::size_t at = from;
    for (std::size_t steps = 0; steps < hull.size(); ++steps) {
        const std::size_t next = (at + 1) % hull.size();
        if (dot2(minus(hull[next], hull[at]), direction) < 0) break;
        at = next;
    }
    return at;
}

Rectangle spanned(Point2 along, double length, double width) {
    if (length >= width) return {along, length, width};
    return {{-along.y, along.x}, width, length};
}

Rectangle turn_around(const std::vector<Point2>& hull) {
    assert(hull.size() >= 3);
    Rectangle best;
    double least = std::numeric_limits<double>::infinity();
    std::size_t right = 0;
    std::size_t top = 0;
    std::size_t left = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point2 edge = minus(hull[(i + 1) % hull.size()], hull[i]);
        const double size = std::hypot(edge.x, edge.y);
        const Point2 u{edge.x / size, edge.y / size};
        const Point2 v{-u.y, u.x};
        if (i == 0) right = 1;
        right = advance(hull, right, u);
        top = advance(hull, i == 0 ? right : top, v);
        left = advance(hull, i == 0 ? top : left, {-u.x, -u.y});
        const double length = dot2(minus(hull[right], hull[left]), u);
        const double width = dot2(minus(hull[top], hull[i]), v);
        if (length * width >= least) continue;
        least = length * width;
        best = spanned(u, length, width);
    }
    return best;
}

// Removes points inside the polygon of the extreme points in eight directions: no corner of the hull lies there (S. G.
// Akl and G. T. Toussaint, "A fast convex hull algorithm", 1978). Those within rounding of a side stay.
void remove_inner_points(std::vector<Point2>& points) {
    constexpr std::array<Point2, 8> directions{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    std::array<Point2, 8> extreme;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        extreme[k] = *std::max_element(points.begin(), points.end(), [&](Point2 a, Point2 b) {
            return dot2(directions[k], a) < dot2(directions[k], b);
        });
    }
    const Point2 size = minus(extreme[1], extreme[5]);
    const double rounding = 1e-9 * (std::abs(extreme[0].x) + std::abs(extreme[4].x) + std::abs(extreme[2].y) +
                                    std::abs(extreme[6].y) + std::hypot(size.x, size.y));
    std::erase_if(points, [&](Point2 p) {
        for (std::size_t k = 0; k < extreme.size(); ++k) {
            const Point2 side = minus(extreme[(k + 1) % extreme.size()], extreme[k]);
            const double length = std::abs(side.x) + std::abs(side.y);
            if (length > 0 && cross2(side, minus(p, extreme[k])) <= rounding * length) return false;
        }
        return true;
    });
}

}  // namespace

std::vector<Point2> convex_hull(std::vector<Point2> points) {
    if (points.empty()) return points;
    remove_inner_points(points);
    std::sort(points.begin(), points.end(), [](Point2 a, Point2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Point2> hull;
    add_chain(hull, points.begin(), points.end());
    add_chain(hull, points.rbegin(), points.rend());
    return hull;
}

Rectangle smallest_rectangle(std::vector<Point2> points) {
    const std::vector<Point2> hull = convex_hull(std::move(points));
    if (hull.size() >= 3) return turn_around(hull);
    if (hull.size() < 2) return {};
    const Point2 edge = minus(hull[1], hull[0]);
    const double length = std::hypot(edge.x, edge.y);
    return {{edge.x / length, edge.y / length}, length, 0};
}

std::array<Vec3, 2> frame_under(Vec3 up) {
    assert(norm(up) > 0);
    // The axis that is least along `up` is the safest to build on.
    const double x = std::abs(up.x);
    const double y = std::abs(up.y);
    const double z = std::abs(up.z);
    const Vec3 aside = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 first = normalized(aside - dot(aside, up) * up);
    return {first, cross(up, first)};
}

}  // namespace qchopper
