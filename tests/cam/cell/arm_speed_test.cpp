// Speeds of joints and of the tool tip.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cam/cell/arm.h"
#include "tests/cam/cell/arm_poses.h"
#include "tests/reference/cam/cell/joint_speeds.h"

namespace qchopper {
namespace {

TEST(Arm, JacobianIsTheDerivativeOfTheFlange) {
    constexpr double h = 1e-5;
    for (const NamedArm& arm : all_arms()) {
        std::mt19937 random(10);
        for (int i = 0; i < 200; ++i) {
            const Joints joints = random_joints(arm, random);
            const Jacobian rows = jacobian(arm.geometry, joints);
            const Pose here = forward(arm.geometry, joints);
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                Joints before = joints;
                Joints after = joints;
                before[axis] -= h;
                after[axis] += h;
                const Pose a = forward(arm.geometry, before);
                const Pose b = forward(arm.geometry, after);
                Vec3 angular;  // sum of c x dc / 2 over the columns c of a rotation that changes by w x c
                for (int k = 0; k < 3; ++k) {
                    angular = angular + (0.5 / (2 * h)) * cross(column(here, k), column(b, k) - column(a, k));
                }
                const Vec3 linear = (1 / (2 * h)) * (b.shift - a.shift);
                expect_near({rows[0][axis], rows[1][axis], rows[2][axis]}, linear, 1e-5, arm.name);
                expect_near({rows[3][axis], rows[4][axis], rows[5][axis]}, angular, 1e-8, arm.name);
            }
        }
    }
}

TEST(Arm, JointSpeedsMoveTheToolTip) {
    constexpr double h = 1e-4;  // s
    const Vec3 tip_in_flange{30, -20, 550};
    const CartesianVelocity wanted{{40, -25, 10}, {0.05, 0.02, -0.04}};
    for (const NamedArm& arm : all_arms()) {
        std::mt19937 random(11);
        int moved = 0;
        for (int i = 0; i < 500; ++i) {
            const Joints joints = random_joints(arm, random);
            const ArmSingularity nearness = singularity(arm.geometry, joints);
            if (nearness.wrist < 0.15 || nearness.shoulder < 150 || nearness.elbow < 0.02) continue;
            const auto speeds = joint_speeds(arm.geometry, joints, tip_in_flange, wanted);
            ASSERT_TRUE(speeds) << arm.name;
            Joints before = joints;
            Joints after = joints;
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                before[axis] -= h * (*speeds)[axis];
                after[axis] += h * (*speeds)[axis];
            }
            const Pose a = forward(arm.geometry, before);
            const Pose b = forward(arm.geometry, after);
            const Pose here = forward(arm.geometry, joints);
            expect_near((1 / (2 * h)) * (apply(b, tip_in_flange) - apply(a, tip_in_flange)), wanted.linear, 1e-3,
                        arm.name);
            for (int k = 0; k < 3; ++k) {
                expect_near((1 / (2 * h)) * (column(b, k) - column(a, k)), cross(wanted.angular, column(here, k)), 1e-5,
                            arm.name);
            }
            ++moved;
        }
        EXPECT_GT(moved, 100) << arm.name;
    }
}

TEST(Arm, LargestJointSpeedsAreThoseOfAllDirections) {
    for (const NamedArm& arm : real_arms()) {
        std::mt19937 random(12);
        for (int i = 0; i < 50; ++i) {
            const Joints joints = random_joints(arm, random);
            const auto largest = largest_joint_speeds(arm.geometry, joints);
            const ArmSingularity nearness = singularity(arm.geometry, joints);
            if (nearness.wrist < 0.15 || nearness.shoulder < 150 || nearness.elbow < 0.02) continue;
            ASSERT_TRUE(largest);
            Joints found{};
            for (int k = 0; k < 2000; ++k) {
                const double z = 1 - (2.0 * k + 1) / 2000;
                const double a = k * 2.399963;
                const Vec3 unit{std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z};
                const auto speeds = joint_speeds(arm.geometry, joints, {20, 30, 500}, {unit, {}});
                ASSERT_TRUE(speeds);
                for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                    found[axis] = std::max(found[axis], std::abs((*speeds)[axis]));
                    EXPECT_LE(std::abs((*speeds)[axis]), (*largest)[axis] * (1 + 1e-9));
                }
            }
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) EXPECT_GE(found[axis], 0.99 * (*largest)[axis]);
        }
        EXPECT_FALSE(largest_joint_speeds(arm.geometry, Joints{NAN}));
    }
}

TEST(Arm, NoJointSpeedsAtASingularity) {
    for (const NamedArm& arm : real_arms()) {
        const ArmGeometry& g = arm.geometry;
        EXPECT_FALSE(joint_speeds(g, radians({10, -70, 60, 30, 0, 20}), {}, {{1, 2, 3}, {}})) << arm.name;
        EXPECT_TRUE(joint_speeds(g, radians({10, -70, 60, 30, 0.01, 20}), {}, {{1, 2, 3}, {}})) << arm.name;
        EXPECT_FALSE(largest_joint_speeds(g, radians({10, -70, 60, 30, 0, 20}))) << arm.name;
        EXPECT_TRUE(largest_joint_speeds(g, radians({10, -70, 60, 30, 0.01, 20}))) << arm.name;
        const double stretched = g.c2 + std::hypot(g.a2, g.c3);
        for (const ArmAnswer& answer : inverse(g, {Pose{}.row, {g.a1 + stretched + 1e-8, 0, g.c1 + g.c4}})) {
            EXPECT_FALSE(joint_speeds(g, answer.joints, {}, {{1, 2, 3}, {}})) << arm.name;
            EXPECT_FALSE(largest_joint_speeds(g, answer.joints)) << arm.name;
        }
    }
}

TEST(Arm, JointSpeedsDoNotDependOnTheDirectionsOfTheAxes) {
    // Axes along x, y and z of the base: the Jacobian has zeros on its diagonal.
    const NamedArm arm = kr_120_r2500_pro();
    const auto speeds = joint_speeds(arm.geometry, radians({0, -90, 90, 0, 90, 0}), {}, {{0, 135, 0}, {0, 0, 0.1}});
    ASSERT_TRUE(speeds);
    EXPECT_TRUE(largest_joint_speeds(arm.geometry, radians({0, -90, 90, 0, 90, 0})));
    // The flange at x = 1350 mm turns about axis 1, whose joint counts the other way.
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) EXPECT_NEAR((*speeds)[axis], axis == 0 ? -0.1 : 0, 1e-12);
}

}  // namespace
}  // namespace qchopper
