// A rigid motion: rotation by rows, then a shift. piece_in_setup turns piece coordinates into setup coordinates.
//
// Millimetres. The rows are orthonormal with determinant +1; there and back is identity
// (tests/cam/setup/setup_test.cpp).

#pragma once

#include <array>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Pose {
    std::array<Vec3, 3> row{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;
    bool operator==(const Pose&) const = default;
};

inline Vec3 apply(const Pose& pose, Vec3 p) {
    return Vec3{dot(pose.row[0], p), dot(pose.row[1], p), dot(pose.row[2], p)} + pose.shift;
}

inline Vec3 apply_inverse(const Pose& pose, Vec3 q) {
    const Vec3 p = q - pose.shift;
    return p.x * pose.row[0] + p.y * pose.row[1] + p.z * pose.row[2];
}

inline TriangleMesh apply(const Pose& pose, TriangleMesh mesh) {
    for (Vec3& p : mesh.points) p = apply(pose, p);
    return mesh;
}

}  // namespace qchopper
