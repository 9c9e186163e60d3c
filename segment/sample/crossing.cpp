#include "segment/sample/crossing.h"

#include <array>
#include <cstddef>

namespace qchopper {
namespace {

// Two triangles at one edge that lie back to back within about 26 degrees count as crossing.
constexpr double back_to_back = -0.9;

double six_volumes(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return dot(b - a, cross(c - a, d - a));
}

bool segment_meets(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
    const double height_p = six_volumes(a, b, c, p);
    const double height_q = six_volumes(a, b, c, q);
    if ((height_p > 0 && height_q > 0) || (height_p < 0 && height_q < 0)) return false;
    const double ab = six_volumes(p, q, a, b);
    const double bc = six_volumes(p, q, b, c);
    const double ca = six_volumes(p, q, c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

Vec3 normal_of(const std::vector<Vec3>& points, const Triangle& t) {
    return normalized(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
}

// Whether the edge of `a` from corner k meets `b`.
bool edge_meets(const std::vector<Vec3>& points, const Triangle& a, std::size_t k, const Triangle& b) {
    return segment_meets(points[a[k]], points[a[(k + 1) % 3]], points[b[0]], points[b[1]], points[b[2]]);
}

}  // namespace

bool triangles_cross(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b) {
    std::size_t shared = 0;
    std::size_t in_a = 0;
    std::size_t in_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (a[i] != b[j]) continue;
            ++shared;
            in_a = i;
            in_b = j;
        }
    }
    if (shared == 3) return true;
    if (shared == 2) return dot(normal_of(points, a), normal_of(points, b)) < back_to_back;
    if (shared == 1) return edge_meets(points, a, (in_a + 1) % 3, b) || edge_meets(points, b, (in_b + 1) % 3, a);
    for (std::size_t k = 0; k < 3; ++k) {
        if (edge_meets(points, a, k, b) || edge_meets(points, b, k, a)) return true;
    }
    return false;
}

}  // namespace qchopper
