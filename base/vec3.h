// A point or a vector in space: three doubles, millimetres unless a header states another unit.

#pragma once

#include <cassert>
#include <cmath>

namespace qchopper {

struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Vec3&) const = default;
    // Precondition: axis is 0, 1 or 2.
    double operator[](int axis) const {
        assert(axis >= 0 && axis < 3);
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    double& operator[](int axis) {
        assert(axis >= 0 && axis < 3);
        return axis == 0 ? x : axis == 1 ? y : z;
    }
};

inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(double s, Vec3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) {
    return std::sqrt(dot(a, a));
}
// The zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
    const double length = norm(a);
    return length > 0 ? (1 / length) * a : a;
}

}  // namespace qchopper
