// The arms for which a cell file can be made: their lengths, zero positions, joint ranges and speeds as published.
//
// mm, degrees, degrees/s, kg: the figures as they stand in the source, so that a person can compare them with it.
// geometry_of() and ranges_of() have radians. The table is in known_arm_rows.cpp; each row names its source.
// Tests (tests/cam/cell/known_arms_test.cpp): forward() of every row is the product of the joint transforms that the
// source gives, and inverse() finds the joints again.

#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cam/cell/arm.h"

namespace qchopper {

enum class Maker { kuka, abb, fanuc, staubli };

// What the arms of a maker have in common.
struct MakerOfArms {
    Maker maker = Maker::kuka;
    std::string_view name;
    std::array<double, axes_of_arm> offset_deg{};
    std::array<int, axes_of_arm> sign{};
    std::string_view dialect;  // of the cell files made for its arms: "krl" or "rapid"
    // One sentence on what the maker's controllers do otherwise than the program assumes; empty: nothing.
    std::string_view notice;
};

struct KnownArm {
    std::string_view id;    // "kr210-r2700", as --robot takes it
    std::string_view name;  // the maker's name of the type
    Maker maker = Maker::kuka;
    std::array<double, 7> lengths{};  // a1, a2, b, c1, c2, c3, c4
    // The zero of the controller's coordinates above the foot of the arm. Some makers count heights from axis 2; c1 is
    // then 0, and the base of the robot stands higher.
    double base_height = 0;
    double payload_kg = 0;
    std::array<double, axes_of_arm> min_deg{};
    std::array<double, axes_of_arm> max_deg{};
    std::array<double, axes_of_arm> speed_deg_per_s{};
    bool are_limits_assumed = false;  // ranges and speeds are not those of the source, or not of each axis alone
    bool is_payload_assumed = false;  // it does not follow from the name of the type
    std::string_view source;
};

// An arm, or a family of arms, that is asked for and cannot be had.
struct RefusedArm {
    std::string_view beginning;  // of the name as plain_name() gives it
    std::string_view why;
};

// By maker, the largest first.
std::span<const KnownArm> known_arms();

const MakerOfArms& maker_of(const KnownArm& arm);

ArmGeometry geometry_of(const KnownArm& arm);
// Accelerations: full speed within half a second (assumed).
JointRanges ranges_of(const KnownArm& arm);

// The arm of that id or name, whatever its letter case, spaces and signs: "KR 210 R2700" is kr210-r2700. Throws
// InputError (use) for another one: with the reason where the program has no kinematics for it, else with the nearest
// names.
const KnownArm& known_arm(const std::string& name);

// The farthest that the wrist comes from axis 1, stretched level as far as the range of axis 2 lets it, mm: what makers
// call the reach.
double reach_of(const KnownArm& arm);

// Joint angles at which a person compares the arm with the controller's display, radians: the first is
// straight_down_joints(), each other one moves three axes from there. None turns an axis by more than 70 degrees.
std::array<Joints, 5> comparison_joints(const ArmGeometry& arm);

// The upper arm upright, the forearm level, the flange pointing down, joint 6 at zero.
Joints straight_down_joints(const ArmGeometry& arm);

}  // namespace qchopper
