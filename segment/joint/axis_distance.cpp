// A segment and a triangle that do not cross are nearest at an end of the segment or at an edge of the triangle.

#include "segment/joint/axis_distance.h"

#include <algorithm>

#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

double within_0_1(double t) {
    return std::clamp(t, 0.0, 1.0);
}

double six_volumes(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return dot(cross(b - a, c - a), d - a);
}

// Decided by the signs of volumes; touching counts.
bool do_cross(const Axis& axis, const std::array<Vec3, 3>& t) {
    const double above = six_volumes(t[0], t[1], t[2], axis.begin);
    const double below = six_volumes(t[0], t[1], t[2], axis.end);
    if ((above > 0) == (below > 0) || above == below) return false;
    const double v0 = six_volumes(axis.begin, axis.end, t[0], t[1]);
    const double v1 = six_volumes(axis.begin, axis.end, t[1], t[2]);
    const double v2 = six_volumes(axis.begin, axis.end, t[2], t[0]);
    return (v0 >= 0 && v1 >= 0 && v2 >= 0) || (v0 <= 0 && v1 <= 0 && v2 <= 0);
}

}  // namespace

double distance_between(const Axis& a, const Axis& b) {
    const Vec3 along_a = a.end - a.begin;
    const Vec3 along_b = b.end - b.begin;
    const Vec3 r = a.begin - b.begin;
    const double aa = dot(along_a, along_a);
    const double bb = dot(along_b, along_b);
    const double ab = dot(along_a, along_b);
    const double ar = dot(along_a, r);
    const double br = dot(along_b, r);
    const double denominator = aa * bb - ab * ab;
    double s = denominator > 0 ? within_0_1((ab * br - ar * bb) / denominator) : 0;
    double t = bb > 0 ? (ab * s + br) / bb : 0;
    if (t < 0 || t > 1 || bb == 0) {
        t = within_0_1(t);
        s = aa > 0 ? within_0_1((ab * t - ar) / aa) : 0;
    }
    return norm(a.begin + s * along_a - (b.begin + t * along_b));
}

double distance_between(const Axis& axis, const std::array<Vec3, 3>& triangle) {
    if (do_cross(axis, triangle)) return 0;
    double least = std::min(norm(axis.begin - closest_on_triangle(axis.begin, triangle)),
                            norm(axis.end - closest_on_triangle(axis.end, triangle)));
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min(least, distance_between(axis, Axis{triangle[i], triangle[(i + 1) % 3]}));
    }
    return least;
}

}  // namespace qchopper
