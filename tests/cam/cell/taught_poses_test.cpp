// Faults planted in the arms of the table, one at a time, are found by name from two poses; poses of the arm as it is
// agree.

#include "cam/cell/taught_poses.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "cam/cell/known_arms.h"
#include "cam/cell/kuka_angles.h"

namespace qchopper {
namespace {

constexpr const char* arms[] = {"kr210-r2700", "kr16-r2010-2", "irb6700-200-2.60", "r2000ic-165f", "tx90"};

// As a pendant shows it, to its decimals.
TaughtPose shown(const Pose& pose, const Joints& joints) {
    TaughtPose taught;
    const auto rounded = [](double value, double per_unit) { return std::round(value * per_unit) / per_unit; };
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        taught.joints_deg[axis] = rounded(degrees(joints[axis]), 100);
    }
    const KukaAngles abc = kuka_angles(pose);
    taught.position = {rounded(pose.shift.x, 100), rounded(pose.shift.y, 100), rounded(pose.shift.z, 100)};
    taught.abc_deg = {rounded(degrees(abc.a), 100), rounded(degrees(abc.b), 100), rounded(degrees(abc.c), 100)};
    return taught;
}

std::vector<TaughtPose> two_poses(const ArmGeometry& arm) {
    std::vector<TaughtPose> poses;
    for (const Joints& moved : {Joints{20, -12, 8, 35, -25, 50}, Joints{-35, 14, -20, -60, 15, -40}}) {
        Joints joints = straight_down_joints(arm);
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) joints[axis] += arm.sign[axis] * radians(moved[axis]);
        poses.push_back(shown(forward(arm, joints), joints));
    }
    return poses;
}

// The sentence of the one fault found in a wrong arm.
std::string found(const ArmGeometry& wrong, const std::vector<TaughtPose>& poses) {
    const TaughtPoseCheck check = check_taught_poses(wrong, poses);
    EXPECT_FALSE(check.agrees);
    if (check.faults.empty()) return "nothing";
    std::string sentences;
    for (const ArmFault& fault : check.faults) sentences += (sentences.empty() ? "" : " | ") + fault.sentence;
    return sentences;
}

bool begins(const std::string& text, const std::string& beginning) {
    return text.compare(0, beginning.size(), beginning) == 0 && text.find(" | ") == std::string::npos;
}

TEST(TaughtPoses, OfTheArmAgree) {
    for (const char* id : arms) {
        const ArmGeometry arm = geometry_of(known_arm(id));
        const TaughtPoseCheck check = check_taught_poses(arm, two_poses(arm));
        EXPECT_TRUE(check.agrees) << id;
        EXPECT_TRUE(check.faults.empty());
        EXPECT_TRUE(check.still_axes.empty());
        EXPECT_LT(check.deviations[1].distance, 0.5);
    }
}

TEST(TaughtPoses, AWrongSignOfEachAxisIsNamed) {
    for (const char* id : arms) {
        const ArmGeometry arm = geometry_of(known_arm(id));
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            ArmGeometry wrong = arm;
            wrong.sign[axis] = -arm.sign[axis];
            const std::string text = found(wrong, two_poses(arm));
            EXPECT_TRUE(begins(text, "sign of axis " + std::to_string(axis + 1) + " is ")) << id << ": " << text;
        }
    }
}

TEST(TaughtPoses, AWrongOffsetOfEachAxisIsNamed) {
    for (const char* id : arms) {
        const ArmGeometry arm = geometry_of(known_arm(id));
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            for (const double off : {-90.0, 2.0, 37.5}) {
                ArmGeometry wrong = arm;
                wrong.offset[axis] += radians(off);
                const std::string text = found(wrong, two_poses(arm));
                EXPECT_TRUE(begins(text, "offset_deg of axis " + std::to_string(axis + 1) + " is "))
                    << id << " " << off << ": " << text;
            }
        }
    }
}

TEST(TaughtPoses, AnOffsetInRadiansIsNamed) {
    for (const char* id : arms) {
        const ArmGeometry arm = geometry_of(known_arm(id));
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            if (arm.offset[axis] == 0) continue;
            ArmGeometry wrong = arm;
            wrong.offset[axis] = radians(arm.offset[axis]);
            const std::string text = found(wrong, two_poses(arm));
            EXPECT_TRUE(begins(text, "offset_deg of axis " + std::to_string(axis + 1))) << id << ": " << text;
            EXPECT_NE(text.find("it stands in radians"), std::string::npos) << id << ": " << text;
        }
    }
}

TEST(TaughtPoses, EachWrongLengthIsNamed) {
    constexpr std::pair<const char*, double ArmGeometry::*> lengths[] = {
        {"a1", &ArmGeometry::a1}, {"a2", &ArmGeometry::a2}, {"b", &ArmGeometry::b},  {"c1", &ArmGeometry::c1},
        {"c2", &ArmGeometry::c2}, {"c3", &ArmGeometry::c3}, {"c4", &ArmGeometry::c4}};
    for (const char* id : arms) {
        const ArmGeometry arm = geometry_of(known_arm(id));
        for (const auto& [key, length] : lengths) {
            ArmGeometry wrong = arm;
            wrong.*length += 15;
            std::string text = found(wrong, two_poses(arm));
            EXPECT_TRUE(begins(text, std::string(key) + " is ")) << id << ": " << text;
            if (arm.*length == 0) continue;
            wrong.*length = (arm.*length) / 1000;
            text = found(wrong, two_poses(arm));
            EXPECT_TRUE(begins(text, std::string(key) + " is ")) << id << ": " << text;
            EXPECT_NE(text.find("it stands in metres"), std::string::npos) << id << ": " << text;
            wrong.*length = -(arm.*length);
            text = found(wrong, two_poses(arm));
            EXPECT_NE(text.find("its sign is wrong"), std::string::npos) << id << ": " << text;
        }
    }
}

TEST(TaughtPoses, UnitsOfTheWholeArmAreNamed) {
    const ArmGeometry arm = geometry_of(known_arm("kr210-r2700"));
    ArmGeometry metres = arm;
    for (double* length : {&metres.a1, &metres.a2, &metres.b, &metres.c1, &metres.c2, &metres.c3, &metres.c4}) {
        *length /= 1000;
    }
    EXPECT_TRUE(begins(found(metres, two_poses(arm)), "a1 to c4 stand in metres"));
    const ArmGeometry fanuc = geometry_of(known_arm("m20ia"));
    ArmGeometry radian = fanuc;
    for (double& offset : radian.offset) offset = radians(offset);
    EXPECT_TRUE(begins(found(radian, two_poses(fanuc)), "offset_deg stands in radians"));
}

// What was read from the display in another way.
TEST(TaughtPoses, AnotherReadingOfTheDisplayIsNamed) {
    const ArmGeometry arm = geometry_of(known_arm("irb4600-40-2.55"));
    const auto changed = [&](auto change) {
        std::vector<TaughtPose> poses = two_poses(arm);
        for (TaughtPose& pose : poses) change(pose);
        return found(arm, poses);
    };
    EXPECT_TRUE(begins(changed([](TaughtPose& p) { p.position = 0.001 * p.position; }), "X, Y, Z of the poses stand"));
    EXPECT_TRUE(begins(changed([](TaughtPose& p) {
                           for (double& joint : p.joints_deg) joint = radians(joint);
                       }),
                       "the joints of the poses stand in radians"));
    EXPECT_TRUE(begins(changed([](TaughtPose& p) {
                           for (double& angle : p.abc_deg) angle = radians(angle);
                       }),
                       "A, B, C of the poses stand in radians"));
    EXPECT_TRUE(begins(changed([](TaughtPose& p) { std::swap(p.abc_deg[0], p.abc_deg[2]); }),
                       "the angles of the poses are given about x, y, z"));
    EXPECT_TRUE(begins(changed([](TaughtPose& p) { p.joints_deg[2] -= p.joints_deg[1]; }),
                       "joint 3 of the poses counts from the horizontal"));
}

TEST(TaughtPoses, AnActiveToolOrBaseIsNamed) {
    const ArmGeometry arm = geometry_of(known_arm("kr120-r2500-pro"));
    const Pose frame = pose_of({radians(10), radians(-20), radians(30)}, {100, -50, 350});
    std::vector<TaughtPose> with_tool;
    std::vector<TaughtPose> in_base;
    for (const TaughtPose& pose : two_poses(arm)) {
        Joints joints{};
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) joints[axis] = radians(pose.joints_deg[axis]);
        with_tool.push_back(shown(forward(arm, joints) * frame, joints));
        in_base.push_back(shown(frame * forward(arm, joints), joints));
    }
    const std::string tool = found(arm, with_tool);
    EXPECT_TRUE(begins(tool, "a tool is active in the controller: X 100.0, Y -50.0, Z 350.0, A ")) << tool;
    EXPECT_TRUE(begins(found(arm, in_base), "the controller shows the poses in another base"));
}

TEST(TaughtPoses, SeveralWrongSignsAreNamedTogether) {
    const ArmGeometry arm = geometry_of(known_arm("kr210-r2700"));
    ArmGeometry wrong = arm;
    wrong.sign[0] = -arm.sign[0];
    wrong.sign[3] = -arm.sign[3];
    wrong.sign[5] = -arm.sign[5];
    EXPECT_TRUE(begins(found(wrong, two_poses(arm)), "the signs of axes 1, 4 and 6 should all be turned round"));
}

TEST(TaughtPoses, WhatNoSingleFaultExplainsNamesNone) {
    const ArmGeometry arm = geometry_of(known_arm("kr210-r2700"));
    ArmGeometry wrong = arm;
    wrong.c2 += 40;
    wrong.offset[2] += 0.3;
    EXPECT_EQ(found(wrong, two_poses(arm)), "nothing");
}

// Two poses in which an axis stays hide its sign where it stays at zero.
TEST(TaughtPoses, AxesThatDidNotMoveAreListed) {
    const ArmGeometry arm = geometry_of(known_arm("kr210-r2700"));
    std::vector<TaughtPose> poses;
    for (const double first : {10.0, 50.0}) {
        Joints joints = straight_down_joints(arm);
        joints[0] = radians(first);
        poses.push_back(shown(forward(arm, joints), joints));
    }
    EXPECT_EQ(check_taught_poses(arm, poses).still_axes, (std::vector<int>{2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace qchopper
