// Sums over points of a surface from which its best planes and axes follow without reading the points again.
//
// mm. Sums of two sets are the sums of their union (tests/segment/regions/moments_test.cpp).

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

// A symmetric matrix: xx, yy, zz, xy, xz, yz.
using Symmetric3 = std::array<double, 6>;

inline void add_product(Symmetric3& m, Vec3 p, double weight) {
    m[0] += weight * p.x * p.x;
    m[1] += weight * p.y * p.y;
    m[2] += weight * p.z * p.z;
    m[3] += weight * p.x * p.y;
    m[4] += weight * p.x * p.z;
    m[5] += weight * p.y * p.z;
}
inline double trace(const Symmetric3& m) {
    return m[0] + m[1] + m[2];
}
// v^T m v
inline double quadratic(const Symmetric3& m, Vec3 v) {
    return m[0] * v.x * v.x + m[1] * v.y * v.y + m[2] * v.z * v.z +
           2 * (m[3] * v.x * v.y + m[4] * v.x * v.z + m[5] * v.y * v.z);
}

struct PointMoments {
    double weight = 0;
    Vec3 sum;
    Symmetric3 products{};

    void add(Vec3 point, double with_weight) {
        weight += with_weight;
        sum = sum + with_weight * point;
        add_product(products, point, with_weight);
    }
    // All points of a triangle, weighted by area.
    void add_triangle(const std::array<Vec3, 3>& corner, double area);
    // All points of a straight edge, weighted by length.
    void add_edge(Vec3 a, Vec3 b);
    void add(const PointMoments& other);
    Vec3 centre() const { return weight > 0 ? (1 / weight) * sum : sum; }
    // Mean products about the centre.
    Symmetric3 covariance() const;
};

// Unit vectors, and the mean squares along them, ascending.
struct PrincipalAxes {
    std::array<Vec3, 3> direction;
    std::array<double, 3> square{};
};
PrincipalAxes principal_axes(const Symmetric3& m);

}  // namespace qchopper
