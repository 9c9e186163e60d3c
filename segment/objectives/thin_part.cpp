// Clipping of a convex polygon at a plane, edge by edge (I. E. Sutherland and G. W. Hodgman, Reentrant polygon
// clipping, 1974); the centroid from a fan of triangles. O(1).

#include "segment/objectives/thin_part.h"

#include <cassert>

namespace qchopper {

ThinPart thin_part(const TriangleMesh& mesh, std::size_t triangle, const Plane& plane, bool above) {
    ThinPart part;
    const Triangle& v = mesh.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = mesh.points[v[k]];
        const Vec3 b = mesh.points[v[(k + 1) % 3]];
        const double ha = height(plane.normal, a);
        const double hb = height(plane.normal, b);
        if ((ha >= plane.offset) == above) part.add(a);
        if ((ha >= plane.offset) != (hb >= plane.offset)) part.add(a + ((plane.offset - ha) / (hb - ha)) * (b - a));
    }
    return part;
}

Centroid centroid(const ThinPart& part) {
    assert(part.corners >= 0 && part.corners <= 4);
    Centroid c;
    const Vec3 a = part.corner[0];
    for (std::size_t k = 2; k < static_cast<std::size_t>(part.corners); ++k) {
        const Vec3 b = part.corner[k - 1];
        const Vec3 d = part.corner[k];
        const double area = 0.5 * norm(cross(b - a, d - a));
        c.area += area;
        c.at = c.at + (area / 3) * (a + b + d);
    }
    if (c.area > 0) c.at = (1 / c.area) * c.at;
    return c;
}

}  // namespace qchopper
