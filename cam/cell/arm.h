// A robot arm with six axes and a spherical wrist: where its flange is for given joints, and which joints hold it
// there.
//
// After M. Brandstötter, A. Angerer and M. Hofbaur, "An analytical solution of the inverse kinematics problem of
// industrial serial manipulators with an ortho-parallel basis and a spherical wrist" (2014). mm, radians, seconds. A
// pose is that of the flange in the frame of the robot's base: z up, x forward at zero; the flange's z points out of
// it. Pure functions that allocate nothing, for any number of threads. forward() of every answer of inverse() is the
// pose that was asked for, to 1e-6 mm and 1e-9 rad (tests/cam/cell/arm_test.cpp).
//
// An angle is a rotation in the convention of the paper, a joint is what the controller shows. Preconditions of all
// functions: c2 > 0, a2 and c3 are not both 0, each sign is 1 or -1.

#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <optional>

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

// The flange in the base. Joints that are not finite give a pose that is not finite.
Pose forward(const ArmGeometry& arm, const Joints& joints);

// Which of the eight ways to hold a pose. Two of them meet at each singularity, and there rounding decides.
struct ArmConfiguration {
    bool is_back = false;            // the arm bends backwards over axis 1 to the wrist centre
    bool is_elbow_negative = false;  // angle of axis 3 + atan2(a2, c3), in -pi..pi, is negative
    bool is_wrist_flipped = false;   // angle of axis 5, in -pi..pi, is negative
    bool operator==(const ArmConfiguration&) const = default;
};

// The configuration of finite joints.
ArmConfiguration configuration_of(const ArmGeometry& arm, const Joints& joints);

struct ArmAnswer {
    Joints joints{};
    ArmConfiguration configuration;
};

// At most one answer for each configuration.
class ArmAnswers {
 public:
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const ArmAnswer* begin() const { return answers_.data(); }
    const ArmAnswer* end() const { return answers_.data() + size_; }
    // Precondition: i < size().
    const ArmAnswer& operator[](std::size_t i) const {
        assert(i < size_);
        return answers_[i];
    }
    // Precondition: size() < 8.
    void push_back(const ArmAnswer& answer) {
        assert(size_ < answers_.size());
        answers_[size_++] = answer;
    }

 private:
    std::array<ArmAnswer, 8> answers_{};
    std::size_t size_ = 0;
};

// All joints, each in -pi..pi, that hold the flange at a pose, whatever the ranges: 8 answers, or 4 where only the
// front or only the back reaches the wrist centre, or none where neither does or an argument is not finite. A wrist
// centre that is too far by rounding (cosine of the elbow beyond +1 or -1 by at most 1e-9) is reached.
//
// Where the pose leaves joints free, `neighbour` decides, the joints of a pose nearby. At the wrist's singularity (sine
// of angle 5 below 1e-9) joint 4 is that of the neighbour and joint 6 follows; at the shoulder's (wrist centre within
// 1e-9 mm of axis 1) joint 1 of the front is that of the neighbour. The two wrist configurations are then the same
// joints, as are the two elbow configurations of a stretched arm.
ArmAnswers inverse(const ArmGeometry& arm, const Pose& flange, const Joints& neighbour = {});

// The answers of inverse() of which each joint, by whole turns, can lie in its range less `margin` (radians) at both
// ends. Of the turns that lie there the one nearest to the neighbour's joint is given.
ArmAnswers inverse_within(const ArmGeometry& arm, const JointRanges& ranges, double margin, const Pose& flange,
                          const Joints& neighbour = {});

// Whether each joint lies in its range less `margin` (radians) at both ends.
bool is_within(const JointRanges& ranges, double margin, const Joints& joints);

// How near joints are to a singularity, where the arm cannot move in some direction. 0 is singular in each.
struct ArmSingularity {
    double wrist = 0;     // |sin| of angle 5, 0..1: axes 4 and 6 are parallel
    double shoulder = 0;  // mm: distance of the wrist centre from axis 1, measured at right angles to the offset b
    double elbow = 0;     // 1 - distance of the wrist centre from axis 2 / its largest, 0..1: the arm is stretched
};

// An arm folded completely is singular as well, and its elbow is not 0; no range of a real arm contains it.
ArmSingularity singularity(const ArmGeometry& arm, const Joints& joints);

// Row by row. Rows 0..2: velocity of the flange's origin (mm/rad), rows 3..5: angular velocity (rad/rad), both along
// x, y, z of the base; columns: joints.
using Jacobian = std::array<std::array<double, axes_of_arm>, 6>;

// The geometric Jacobian: velocity of the flange = jacobian * speeds of the joints.
Jacobian jacobian(const ArmGeometry& arm, const Joints& joints);

// Of each joint the largest speed, per mm/s of the tool tip (radians/mm), over all directions in which the tip may move
// while its orientation stays: the norm of the first three columns in its row of the inverse Jacobian. Where the tip
// lies in the flange has no influence. Nothing at a singularity, or if a joint is not finite: singular is a
// pivot of at most 1e-9 when lengths are divided by that of the stretched arm.
std::optional<Joints> largest_joint_speeds(const ArmGeometry& arm, const Joints& joints);

}  // namespace qchopper
