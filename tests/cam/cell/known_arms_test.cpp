// The rows of the table of arms against the chains of joints that their sources state, and against poses that other
// people published; names that are found, and those that are refused.

#include "cam/cell/known_arms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "base/error.h"
#include "base/units.h"
#include "tests/cam/cell/published_chains.h"

namespace qchopper {
namespace {

// Rodrigues' formula.
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
}

struct PlainFlange {
    Vec3 position;
    Vec3 x;
    Vec3 z;
};

// Joint by joint from the flange back to the foot.
PlainFlange plain_forward(const PublishedChain& chain, const Joints& joints) {
    const auto directions = directions_of(chain.axes);
    PlainFlange flange{{}, flange_of(chain.axes)[0], flange_of(chain.axes)[1]};
    for (std::size_t i = axes_of_arm; i-- > 0;) {
        flange.position = chain.origins[i] + turned(flange.position, directions[i], joints[i]);
        flange.x = turned(flange.x, directions[i], joints[i]);
        flange.z = turned(flange.z, directions[i], joints[i]);
    }
    flange.position.z -= chain.base_height;
    return flange;
}

Joints random_joints(const JointRanges& ranges, std::mt19937& random) {
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] = std::uniform_real_distribution<double>(ranges[axis].min, ranges[axis].max)(random);
    }
    return joints;
}

Vec3 column(const Pose& pose, int i) {
    return {pose.row[0][i], pose.row[1][i], pose.row[2][i]};
}

TEST(KnownArms, AreThoseOfTheSourcesJointByJoint) {
    std::mt19937 random(37);
    ASSERT_EQ(known_arms().size(), published_chains.size());
    for (const PublishedChain& chain : published_chains) {
        const KnownArm& arm = known_arm(std::string(chain.id));
        const ArmGeometry geometry = geometry_of(arm);
        EXPECT_EQ(arm.base_height, chain.base_height) << chain.id;
        for (int i = 0; i < 200; ++i) {
            const Joints joints = random_joints(ranges_of(arm), random);
            const Pose pose = forward(geometry, joints);
            const PlainFlange plain = plain_forward(chain, joints);
            ASSERT_LT(norm(pose.shift - plain.position), 1e-9) << chain.id;
            ASSERT_LT(norm(column(pose, 0) - plain.x), 1e-12) << chain.id;
            ASSERT_LT(norm(column(pose, 2) - plain.z), 1e-12) << chain.id;
        }
    }
}

TEST(KnownArms, InverseFindsTheJointsAgain) {
    std::mt19937 random(38);
    for (const KnownArm& arm : known_arms()) {
        const ArmGeometry geometry = geometry_of(arm);
        const JointRanges ranges = ranges_of(arm);
        for (int i = 0; i < 200; ++i) {
            const Joints joints = random_joints(ranges, random);
            const Pose pose = forward(geometry, joints);
            double nearest = 1e9;
            for (const ArmAnswer& answer : inverse_within(geometry, ranges, -1e-9, pose, joints)) {
                const Pose again = forward(geometry, answer.joints);
                EXPECT_LT(norm(again.shift - pose.shift), 1e-6) << arm.id;
                double farthest = 0;
                for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                    farthest = std::max(farthest, std::abs(answer.joints[axis] - joints[axis]));
                }
                nearest = std::min(nearest, farthest);
            }
            ASSERT_LT(nearest, 1e-6) << arm.id << " " << i;
        }
    }
}

// The reach that brochures and names of the types give.
TEST(KnownArms, ReachAsTheirNamesSay) {
    constexpr std::pair<const char*, double> rows[] = {{"kr210-r2700", 2696},
                                                       {"kr210-r3100-2", 3100},
                                                       {"kr120-r2500-pro", 2496},
                                                       {"kr60-ha", 2033},
                                                       {"kr340-r3330", 3326},
                                                       {"kr150-r3100-2", 3100},
                                                       {"kr16-2", 1611},
                                                       {"kr16-r2010-2", 2013},
                                                       {"kr20-r1810-2", 1813},
                                                       {"kr22-r1610-2", 1612},
                                                       {"kr10-r1420", 1420},
                                                       {"kr10-r1100-2", 1101},
                                                       {"kr70-r2100", 2101},
                                                       {"irb6640-185-2.8", 2800},
                                                       {"irb6700-235-2.65", 2650},
                                                       {"irb6700-200-2.60", 2600},
                                                       {"irb4600-40-2.55", 2552},
                                                       {"irb4600-60-2.05", 2051},
                                                       {"irb2600-12-1.85", 1853},
                                                       {"irb2600-12-1.65", 1653},
                                                       {"irb1600-10-1.45", 1450},
                                                       {"irb1200-5-0.9", 901},
                                                       {"irb6650s-125-3.5", 3484},
                                                       {"irb7600-150-3.5", 3500},
                                                       {"r2000ic-165f", 2655},
                                                       {"m710ic-50", 2050},
                                                       {"m20ia", 1811},
                                                       {"rx160", 1600}};
    for (const auto& [id, reach] : rows) {
        EXPECT_NEAR(reach_of(known_arm(id)), reach, 4) << id;
    }
}

TEST(KnownArms, EveryRowIsWhole) {
    EXPECT_GE(known_arms().size(), 25U);
    std::set<std::string_view> ids;
    std::set<Maker> makers;
    for (const KnownArm& arm : known_arms()) {
        EXPECT_TRUE(ids.insert(arm.id).second) << arm.id;
        makers.insert(arm.maker);
        EXPECT_NE(arm.source, "") << arm.id;
        EXPECT_EQ(arm.name.find(maker_of(arm).name), 0U) << arm.id;
        const JointRanges ranges = ranges_of(arm);
        for (const Joints& joints : comparison_joints(geometry_of(arm))) {
            EXPECT_TRUE(is_within(ranges, 0, joints)) << arm.id;
        }
        const Pose down = forward(geometry_of(arm), straight_down_joints(geometry_of(arm)));
        EXPECT_NEAR(down.row[2].z, -1, 1e-12) << arm.id;
    }
    EXPECT_EQ(makers.size(), 4U);
}

TEST(KnownArms, AreFoundHoweverTheyAreSpelt) {
    for (const char* name :
         {"kr210-r2700", "KR 210 R2700", "kr210r2700", "KUKA KR 210 R2700 extra", "kuka_kr210_r2700"}) {
        EXPECT_EQ(known_arm(name).id, "kr210-r2700") << name;
    }
    EXPECT_EQ(known_arm("IRB 4600-60/2.05").id, "irb4600-60-2.05");
    EXPECT_EQ(known_arm("R-2000iC/165F").id, "r2000ic-165f");
}

std::string refusal(const char* name) {
    try {
        known_arm(name);
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::use);
        EXPECT_FALSE(error.to_do.empty());
        return error.what();
    }
    return "taken";
}

TEST(KnownArms, WhatHasNoSphericalWristIsRefusedWithTheReason) {
    for (const char* name : {"UR10e", "ur5", "Universal Robots UR20"}) {
        EXPECT_NE(refusal(name).find("three of its axes are parallel"), std::string::npos) << refusal(name);
    }
    EXPECT_NE(refusal("IRB 2400-16").find("parallel linkage"), std::string::npos);
    EXPECT_NE(refusal("LBR iiwa 14").find("seven axes"), std::string::npos);
    EXPECT_NE(refusal("CRX-10iA/L").find("no spherical wrist"), std::string::npos);
    EXPECT_NE(refusal("kr210-r2701").find("kr210-r2700"), std::string::npos) << refusal("kr210-r2701");
    EXPECT_NE(refusal("").find("no robot is known"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
