// A robot arm with six axes and a spherical wrist: where its flange is for given joints, and which joints hold it
// there.
//
// After M. Brandstötter, A. Angerer and M. Hofbaur, "An analytical solution of the inverse kinematics problem of
// industrial serial manipulators with an ortho-parallel basis and a spherical wrist" (2014). mm, radians, seconds. A
// pose is that of the flange in the frame of the robot's base: z up, x forward at zero; the flange's z points out of
// it. Pure functions, for any number of threads. forward() of every answer of inverse() is the pose that was asked for,
// to 1e-6 mm and 1e-9 rad (tests/cam/cell/arm_test.cpp).

#pragma once

#include <array>
#include <cstddef>

#include "base/pose.h"

namespace qchopper {

constexpr std::size_t axes_of_arm = 6;

// Angles as the robot's controller shows them.
using Joints = std::array<double, axes_of_arm>;

// Lengths (mm) and zero position in the convention of the paper, in which all angles are zero with the arm straight up:
// joint = sign * (angle + offset).
struct ArmGeometry {
    double a1 = 0;
    double a2 = 0;
    double b = 0;
    double c1 = 0;
    double c2 = 0;
    double c3 = 0;
    double c4 = 0;
    Joints offset{};                                      // radians
    std::array<int, axes_of_arm> sign{1, 1, 1, 1, 1, 1};  // 1 or -1
    bool operator==(const ArmGeometry&) const = default;
};

struct JointRange {
    double min = 0;           // radians
    double max = 0;           // above min
    double speed = 0;         // largest, radians/s
    double acceleration = 0;  // largest, radians/s2
    bool operator==(const JointRange&) const = default;
};

using JointRanges = std::array<JointRange, axes_of_arm>;

}  // namespace qchopper
