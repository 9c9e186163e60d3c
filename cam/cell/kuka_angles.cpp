// Read off the matrix of Rz(a) Ry(b) Rx(c). c is taken from the second row of Rz(-a) R = Ry(b) Rx(c), which is 0, cos
// c, -sin c: near b = +-90 degrees, where a is inexact, c then makes up for it.

#include "cam/cell/kuka_angles.h"

#include <cmath>

namespace qchopper {
namespace {

constexpr double smallest_cosine = 1e-9;  // of b; below, a and c turn about the same axis

}  // namespace

KukaAngles kuka_angles(const Pose& pose) {
    const auto& [r1, r2, r3] = pose.row;
    const double cosine = std::hypot(r1.x, r2.x);
    KukaAngles angles;
    angles.b = std::atan2(-r3.x, cosine);
    if (cosine < smallest_cosine) {
        angles.a = std::atan2(-r1.y, r2.y);
        return angles;
    }
    const double sin_a = r2.x / cosine;
    const double cos_a = r1.x / cosine;
    angles.a = std::atan2(r2.x, r1.x);
    angles.c = std::atan2(sin_a * r1.z - cos_a * r2.z, cos_a * r2.y - sin_a * r1.y);
    return angles;
}

Pose pose_of(const KukaAngles& angles, Vec3 shift) {
    const double ca = std::cos(angles.a);
    const double sa = std::sin(angles.a);
    const double cb = std::cos(angles.b);
    const double sb = std::sin(angles.b);
    const double cc = std::cos(angles.c);
    const double sc = std::sin(angles.c);
    return {{Vec3{ca * cb, ca * sb * sc - sa * cc, ca * sb * cc + sa * sc},
             Vec3{sa * cb, sa * sb * sc + ca * cc, sa * sb * cc - ca * sc}, Vec3{-sb, cb * sc, cb * cc}},
            shift};
}

}  // namespace qchopper
