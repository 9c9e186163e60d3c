// Robot arms for tests and measurements: geometry, ranges and speeds of joints after the data sheets; a joint's
// acceleration is assumed, its speed within half a second. mm and radians.

#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "cam/cell/arm.h"

namespace qchopper {

struct NamedArm {
    std::string name;
    ArmGeometry geometry;
    JointRanges ranges{};
};

inline double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

inline Joints radians(const Joints& degrees) {
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) joints[axis] = radians(degrees[axis]);
    return joints;
}

// From degrees and degrees/s.
inline JointRange joint_range(double min, double max, double speed) {
    return {radians(min), radians(max), radians(speed), radians(speed / 0.5)};
}

inline NamedArm kr_60_ha() {
    return {"KR 60 HA",
            {350, -145, 0, 815, 850, 820, 170, radians({0, -90, 0, 0, 0, 0}), {-1, 1, 1, -1, 1, -1}},
            {joint_range(-185, 185, 128), joint_range(-135, 35, 102), joint_range(-120, 158, 128),
             joint_range(-350, 350, 260), joint_range(-119, 119, 245), joint_range(-350, 350, 322)}};
}

inline NamedArm kr_120_r2500_pro() {
    return {"KR 120 R2500 pro",
            {350, 41, 0, 675, 1150, 1000, 215, radians({0, -90, 0, 0, 0, 0}), {-1, 1, 1, -1, 1, -1}},
            {joint_range(-185, 185, 136), joint_range(-140, -5, 130), joint_range(-120, 155, 120),
             joint_range(-350, 350, 292), joint_range(-125, 125, 258), joint_range(-350, 350, 284)}};
}

inline NamedArm irb_6640_185() {
    return {"IRB 6640-185/2.8",
            {320, -200, 0, 780, 1075, 1392, 200, radians({0, 0, -90, 0, 0, 0}), {1, 1, 1, 1, 1, 1}},
            {joint_range(-170, 170, 100), joint_range(-65, 85.1, 90), joint_range(-180, 70, 90),
             joint_range(-300, 300, 170), joint_range(-120, 120, 140), joint_range(-360, 360, 190)}};
}

// No real robot: its arm is offset sideways, and each axis has a zero position of its own.
inline NamedArm offset_arm() {
    NamedArm arm = kr_120_r2500_pro();
    arm.name = "offset arm";
    arm.geometry.b = 120;
    arm.geometry.offset = radians({15, -80, 10, -25, 5, 190});
    arm.geometry.sign = {1, -1, 1, 1, -1, 1};
    arm.ranges[1] = joint_range(-200, 200, 130);
    return arm;
}

inline std::vector<NamedArm> real_arms() {
    return {kr_60_ha(), kr_120_r2500_pro(), irb_6640_185()};
}

}  // namespace qchopper
