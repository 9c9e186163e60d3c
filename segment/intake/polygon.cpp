#include "segment/intake/polygon.h"

#include <cstddef>

namespace qchopper {
namespace {

// Newell's normal: right for concave and slightly bent polygons.
Vec3 mean_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
    Vec3 sum;
    const Vec3 origin = points[corners[0]];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = points[corners[i]] - origin;
        const Vec3 b = points[corners[(i + 1) % corners.size()]] - origin;
        sum = sum + cross(a, b);
    }
    return sum;
}

double turn(Vec3 normal, Vec3 a, Vec3 b, Vec3 c) {
    return dot(normal, cross(b - a, c - a));
}

// An ear turns left and holds no other corner of what is left of the polygon.
bool is_ear(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& ring, std::size_t tip, Vec3 normal) {
    const std::size_t n = ring.size();
    const std::uint32_t before = ring[(tip + n - 1) % n];
    const std::uint32_t after = ring[(tip + 1) % n];
    const Vec3 a = points[before];
    const Vec3 b = points[ring[tip]];
    const Vec3 c = points[after];
    if (!(turn(normal, a, b, c) > 0)) return false;
    for (const std::uint32_t corner : ring) {
        if (corner == before || corner == ring[tip] || corner == after) continue;
        const Vec3 p = points[corner];
        if (turn(normal, a, b, p) >= 0 && turn(normal, b, c, p) >= 0 && turn(normal, c, a, p) >= 0) return false;
    }
    return true;
}

}  // namespace

void split_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                   std::vector<Triangle>& triangles) {
    const Vec3 normal = mean_normal(points, corners);
    std::vector<std::uint32_t> ring(corners.begin(), corners.end());
    std::size_t tip = 1;  // of a convex polygon: the fan about the first corner
    while (ring.size() > 3) {
        const std::size_t n = ring.size();
        std::size_t tries = 0;
        while (tries < n && !is_ear(points, ring, tip % n, normal)) {
            ++tip;
            ++tries;
        }
        tip %= n;  // without any ear this is where it was: the polygon is split anyway
        triangles.push_back({ring[(tip + n - 1) % n], ring[tip], ring[(tip + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(tip));
        if (tip == 0) tip = 1;
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
}

}  // namespace qchopper
