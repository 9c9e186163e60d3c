// Finds which value of an arm is wrong, from poses that the controller shows for joints to which the arm was jogged.
//
// Degrees and mm as on the display; the pose is that of the flange (no tool) in the robot's base, A, B, C about z, y,
// x. Pure functions. The faults looked for: one wrong sign, zero position or length, a unit, several signs, joint 3
// that counts from the horizontal, angles in another order, a base or tool that is active in the controller. Tests
// plant each of them (tests/cam/cell/taught_poses_test.cpp).

#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "cam/cell/arm.h"

namespace qchopper {

// What the controller shows.
struct TaughtPose {
    std::array<double, axes_of_arm> joints_deg{};
    Vec3 position;                    // X, Y, Z in mm
    std::array<double, 3> abc_deg{};  // A, B, C
};

struct PoseDeviation {
    double distance = 0;  // mm
    double angle = 0;     // radians
};

// A change of one kind with which the arm shows all poses.
struct ArmFault {
    std::string parameter;  // key of [robot] in the cell file, "joints", "position", "abc", "base" or "tool"
    std::vector<int> axes;  // from 1; empty: of the whole arm
    std::string sentence;   // "sign of axis 2 is 1 and should be -1"
};

struct TaughtPoseCheck {
    std::vector<PoseDeviation> deviations;  // of the arm as given, pose by pose
    bool agrees = false;                    // all within 1 mm and 0.1 degrees
    // The simplest that explain the poses, equally simple ones all; empty where the arm agrees, or nothing explains
    // them.
    std::vector<ArmFault> faults;
    std::vector<int>
        still_axes;  // from 1: differ by less than 5 degrees between all poses, so their sign is not checked
};

// Precondition: at least two poses, all values finite. O(poses * candidates), some 100,000 forward kinematics.
TaughtPoseCheck check_taught_poses(const ArmGeometry& arm, std::span<const TaughtPose> poses);

}  // namespace qchopper
