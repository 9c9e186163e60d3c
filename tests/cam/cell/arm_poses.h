// Poses and joints of arms, drawn and compared.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/cam/cell/arms.h"

namespace qchopper {

inline std::vector<NamedArm> all_arms() {
    std::vector<NamedArm> arms = real_arms();
    arms.push_back(offset_arm());
    return arms;
}

inline Vec3 column(const Pose& pose, int i) {
    return {pose.row[0][i], pose.row[1][i], pose.row[2][i]};
}

// Angle of the rotation from one pose to another, for small angles.
inline double rotation_between(const Pose& a, const Pose& b) {
    double square = 0;
    for (int i = 0; i < 3; ++i) square += dot(column(a, i) - column(b, i), column(a, i) - column(b, i));
    return std::sqrt(square / 2);
}

inline Joints random_joints(const NamedArm& arm, std::mt19937& random) {
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] = std::uniform_real_distribution(arm.ranges[axis].min, arm.ranges[axis].max)(random);
    }
    return joints;
}

inline void expect_near(Vec3 a, Vec3 b, double tolerance, const std::string& what) {
    EXPECT_LE(norm(a - b), tolerance) << what << ": " << a.x << " " << a.y << " " << a.z << " is not " << b.x << " "
                                      << b.y << " " << b.z;
}

}  // namespace qchopper
