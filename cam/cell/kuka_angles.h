// The angles A, B, C by which KUKA's controllers give a rotation: R = Rz(a) Ry(b) Rx(c).
//
// Radians. Pure functions. From angles to a pose and back to the same rotation, to 1e-9
// (tests/cam/cell/kuka_angles_test.cpp).

#pragma once

#include "base/pose.h"

namespace qchopper {

struct KukaAngles {
    double a = 0;  // about z, -pi..pi
    double b = 0;  // about y, -pi/2..pi/2
    double c = 0;  // about x, -pi..pi
    bool operator==(const KukaAngles&) const = default;
};

// The angles of a pose's rotation. Where b is +90 or -90 degrees (cosine below 1e-9) only a - c or a + c is determined:
// c is then 0. Precondition: the pose is finite.
KukaAngles kuka_angles(const Pose& pose);

// The pose with that rotation and shift, for any finite angles.
Pose pose_of(const KukaAngles& angles, Vec3 shift);

}  // namespace qchopper
