// A rigid motion: a rotation given by its rows, then a shift.
//
// Lengths in mm. A pose is named a_in_b: it takes coordinates in frame a to coordinates in frame b, so frames are
// chained as piece_in_cell = stock_in_cell * piece_in_stock. Precondition of all functions: the rows are orthonormal
// with determinant +1. A pose after its inverse is the identity to rounding (tests/base/pose_test.cpp).

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

struct Pose {
    std::array<Vec3, 3> row{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;
    bool operator==(const Pose&) const = default;
};

// The direction v of frame a, in frame b.
inline Vec3 rotate(const Pose& a_in_b, Vec3 v) {
    return {dot(a_in_b.row[0], v), dot(a_in_b.row[1], v), dot(a_in_b.row[2], v)};
}

// The point p of frame a, in frame b.
inline Vec3 apply(const Pose& a_in_b, Vec3 p) {
    return rotate(a_in_b, p) + a_in_b.shift;
}

// The direction v of frame b, in frame a.
inline Vec3 rotate_inverse(const Pose& a_in_b, Vec3 v) {
    return v.x * a_in_b.row[0] + v.y * a_in_b.row[1] + v.z * a_in_b.row[2];
}

// The point p of frame b, in frame a.
inline Vec3 apply_inverse(const Pose& a_in_b, Vec3 p) {
    return rotate_inverse(a_in_b, p - a_in_b.shift);
}

// b_in_a.
inline Pose inverse(const Pose& a_in_b) {
    const std::array<Vec3, 3>& r = a_in_b.row;
    const std::array<Vec3, 3> columns{Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y},
                                      Vec3{r[0].z, r[1].z, r[2].z}};
    return {columns, -rotate_inverse(a_in_b, a_in_b.shift)};
}

// a_in_c of b_in_c and a_in_b.
inline Pose operator*(const Pose& b_in_c, const Pose& a_in_b) {
    Pose a_in_c;
    for (std::size_t i = 0; i < 3; ++i) a_in_c.row[i] = rotate_inverse(a_in_b, b_in_c.row[i]);
    a_in_c.shift = apply(b_in_c, a_in_b.shift);
    return a_in_c;
}

}  // namespace qchopper
