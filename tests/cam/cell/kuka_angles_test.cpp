#include "cam/cell/kuka_angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/cam/cell/arm_poses.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double full_turn = 2 * pi;

// Largest difference of two sets of angles, whole turns aside.
double difference(const KukaAngles& a, const KukaAngles& b) {
    return std::max({std::abs(std::remainder(a.a - b.a, full_turn)), std::abs(std::remainder(a.b - b.b, full_turn)),
                     std::abs(std::remainder(a.c - b.c, full_turn))});
}

TEST(KukaAngles, AreThoseOfTheTables) {
    const ArmGeometry arm = kr_120_r2500_pro().geometry;
    const KukaAngles ahead = kuka_angles(forward(arm, radians({0, -90, 90, 0, 0, 0})));
    EXPECT_LT(difference(ahead, {0, pi / 2, 0}), 1e-9);
    EXPECT_EQ(ahead.c, 0);
    EXPECT_LT(difference(kuka_angles(forward(arm, radians({0, -90, 90, 0, 90, 0}))), {pi, 0, pi}), 1e-9);
}

TEST(KukaAngles, AreTurnsAboutZThenYThenX) {
    EXPECT_LT(norm(rotate(pose_of({pi / 2, 0, 0}, {}), {1, 0, 0}) - Vec3{0, 1, 0}), 1e-15);
    EXPECT_LT(norm(rotate(pose_of({0, pi / 2, 0}, {}), {1, 0, 0}) - Vec3{0, 0, -1}), 1e-15);
    EXPECT_LT(norm(rotate(pose_of({0, 0, pi / 2}, {}), {0, 1, 0}) - Vec3{0, 0, 1}), 1e-15);
    const Pose chained = pose_of({0.3, 0, 0}, {}) * pose_of({0, -0.4, 0}, {}) * pose_of({0, 0, 0.5}, {});
    EXPECT_LT(rotation_between(chained, pose_of({0.3, -0.4, 0.5}, {})), 1e-15);
    EXPECT_EQ(pose_of({1, 2, 3}, {4, 5, 6}).shift, (Vec3{4, 5, 6}));
}

TEST(KukaAngles, GiveTheRotationBack) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> turn(-pi, pi);
    std::uniform_real_distribution<double> half(-pi / 2, pi / 2);
    for (int i = 0; i < 10'000; ++i) {
        const KukaAngles angles{turn(random), half(random), turn(random)};
        const Pose pose = pose_of(angles, {});
        const KukaAngles read = kuka_angles(pose);
        EXPECT_LT(difference(read, angles), 1e-9);
        EXPECT_LT(rotation_between(pose_of(read, {}), pose), 1e-12);
    }
}

TEST(KukaAngles, LeaveOutCWhereBIsARightAngle) {
    for (const double side : {1.0, -1.0}) {
        for (const double distance : {0.0, 1e-12, 0.9e-9, 1.1e-9, 1e-8, 1e-6}) {
            const Pose pose = pose_of({0.7, side * (pi / 2 - distance), 0.2}, {});
            const KukaAngles read = kuka_angles(pose);
            EXPECT_LT(rotation_between(pose_of(read, {}), pose), 1.5e-9) << distance;
            const Pose other = pose_of({0.4, 0.5, -0.6}, {});
            const Pose rounded = inverse(other) * (other * pose);
            EXPECT_LT(rotation_between(pose_of(kuka_angles(rounded), {}), rounded), 1.5e-9) << distance;
            if (distance < 1e-9) {
                EXPECT_EQ(read.c, 0) << distance;
                EXPECT_NEAR(read.a, 0.7 - side * 0.2, 2e-9) << distance;
            } else {
                EXPECT_LT(difference(read, {0.7, side * (pi / 2 - distance), 0.2}), 1e-5) << distance;
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
