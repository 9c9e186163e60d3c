// Whether a collapse may change a face so: by at most 60 degrees, and into no needle.
//
// mm. Both ways to collapse (collapse.h, collapse_passes.h) use this one rule. O(1), no root is taken.

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

struct FaceShape {
    Vec3 normal;       // twice the area long
    double sides = 0;  // sum of the squared lengths of the sides
};

inline FaceShape shape_of(const std::array<Vec3, 3>& corner) {
    const Vec3 ab = corner[1] - corner[0];
    const Vec3 bc = corner[2] - corner[1];
    const Vec3 ca = corner[0] - corner[2];
    return {cross(ab, corner[2] - corner[0]), dot(ab, ab) + dot(bc, bc) + dot(ca, ca)};
}

// The square of: 1 for an equilateral triangle, 0 for one without area.
inline double squared_roundness(const FaceShape& shape) {
    return shape.sides > 0 ? 12 * dot(shape.normal, shape.normal) / (shape.sides * shape.sides) : 0;
}

// A needle has no reliable normal, so none may be made; one that exists may become rounder.
inline bool is_sound_change(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after) {
    constexpr double min_roundness = 0.03;
    constexpr double min_of_all = 1e-6;
    constexpr double min_cosine = 0.5;
    const FaceShape old = shape_of(before);
    const FaceShape made = shape_of(after);
    const double cosine = dot(old.normal, made.normal);  // times both lengths
    const double lengths = dot(old.normal, old.normal) * dot(made.normal, made.normal);
    if (!(cosine >= 0) || cosine * cosine < min_cosine * min_cosine * lengths) return false;
    const double round = squared_roundness(made);
    if (round >= min_roundness * min_roundness) return true;
    return round > min_of_all * min_of_all && round >= squared_roundness(old);
}

}  // namespace qchopper
