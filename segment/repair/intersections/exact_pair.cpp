// The predicates of CGAL's exact-predicates kernel, after shared corners are matched by their coordinates. Floating
// point with error bounds, exact arithmetic only where those do not decide.

#include "segment/repair/intersections/exact_pair.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <utility>

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(Vec3 p) {
    return {p.x, p.y, p.z};
}
Kernel::Triangle_3 triangle(const Corners& t) {
    return {point(t[0]), point(t[1]), point(t[2])};
}

// Both triangles with their corners permuted: shared ones first, in the same order.
struct Matched {
    Corners a;
    Corners b;
    int shared = 0;
};

Matched matched(Corners a, Corners b) {
    Matched m{a, b, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = static_cast<std::size_t>(m.shared); j < 3; ++j) {
            if (a[i] != m.b[j]) continue;
            const auto place = static_cast<std::size_t>(m.shared++);
            std::swap(m.b[j], m.b[place]);
            for (std::size_t k = place; k < 3; ++k) {
                if (m.a[k] == a[i]) std::swap(m.a[k], m.a[place]);
            }
            break;
        }
    }
    return m;
}

}  // namespace

bool has_area(const Corners& t) {
    return !CGAL::collinear(point(t[0]), point(t[1]), point(t[2]));
}

bool do_meet(const Corners& first, const Corners& second) {
    const auto [a, b, shared] = matched(first, second);
    if (shared == 3) return true;
    const Point a2 = point(a[2]);
    const Point b2 = point(b[2]);
    if (shared == 2) {
        const Point p = point(a[0]);
        const Point q = point(a[1]);
        return CGAL::coplanar(p, q, a2, b2) && CGAL::coplanar_orientation(p, q, a2, b2) == CGAL::POSITIVE;
    }
    if (shared == 1) {
        return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(b[1]), b2)) ||
               CGAL::do_intersect(triangle(b), Kernel::Segment_3(point(a[1]), a2));
    }
    return CGAL::do_intersect(triangle(a), triangle(b));
}

}  // namespace qchopper
