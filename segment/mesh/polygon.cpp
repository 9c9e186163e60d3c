// Shoelace formula and crossing number, both from corner to corner.

#include "segment/mesh/polygon.h"

namespace qchopper {

double signed_area(std::span<const Point2> points, const Loop& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        twice += orientation(points[loop.front()], points[loop[i]], points[loop[(i + 1) % loop.size()]]);
    }
    return twice / 2;
}

bool is_on_segment(Point2 p, Point2 a, Point2 b, double reach) {
    if (p.x < std::min(a.x, b.x) - reach || p.x > std::max(a.x, b.x) + reach) return false;
    if (p.y < std::min(a.y, b.y) - reach || p.y > std::max(a.y, b.y) + reach) return false;
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double beside = dx * (p.y - a.y) - dy * (p.x - a.x);
    return beside * beside <= reach * reach * (dx * dx + dy * dy) || (dx == 0 && dy == 0);
}

bool is_inside(std::span<const Point2> points, const Loop& loop, Point2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        if (ray_crosses(p, points[loop[i]], points[loop[j]])) inside = !inside;
    }
    return inside;
}

}  // namespace qchopper
