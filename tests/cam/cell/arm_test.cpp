#include "cam/cell/arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/cam/cell/arm_poses.h"
#include "tests/reference/cam/cell/joint_speeds.h"
#include "tests/reference/cam/cell/turns_within.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double full_turn = 2 * pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

double distance_modulo_turns(const Joints& a, const Joints& b) {
    double largest = 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        largest = std::max(largest, std::abs(std::remainder(a[axis] - b[axis], full_turn)));
    }
    return largest;
}

bool is_among(const ArmAnswers& answers, const Joints& joints, double tolerance) {
    return std::any_of(answers.begin(), answers.end(), [&](const ArmAnswer& answer) {
        return distance_modulo_turns(answer.joints, joints) <= tolerance;
    });
}

// Largest errors over the answers of many poses.
struct WorstErrors {
    double position = 0;
    double rotation = 0;
    double joints = 0;
    void add_pose(const Pose& asked, const Pose& got) {
        position = std::max(position, norm(asked.shift - got.shift));
        rotation = std::max(rotation, rotation_between(asked, got));
    }
};

struct PoseOfJoints {
    NamedArm arm;
    Joints degrees;
    Vec3 position;
    Vec3 z_axis;
};

TEST(Arm, FlangeIsWhereTheTablesSay) {
    const Vec3 turned{.257707, -.428045, -.866236};
    const std::vector<PoseOfJoints> cases{
        {kr_120_r2500_pro(), {0, -90, 90, 0, 0, 0}, {1565, 0, 1784}, {1, 0, 0}},
        {kr_120_r2500_pro(), {0, -90, 90, 0, 90, 0}, {1350, 0, 1569}, {0, 0, -1}},
        {kr_120_r2500_pro(), {30, -60, 80, 20, 45, -70}, {1658.134, -1017.365, 1104.141}, turned},
        {kr_60_ha(), {0, -90, 90, 0, 0, 0}, {1340, 0, 1810}, {1, 0, 0}},
        {kr_60_ha(), {30, -60, 80, 20, 45, -70}, {1425.243, -870.338, 1259.660}, turned},
        {irb_6640_185(), {0, 0, 0, 0, 0, 0}, {1912, 0, 2055}, {1, 0, 0}},
        {irb_6640_185(), {0, 0, 0, 0, 90, 0}, {1712, 0, 1855}, {0, 0, -1}},
        {irb_6640_185(), {30, 20, 10, 20, 45, -70}, {1750.481, 1066.492, 1081.576}, {.121687, .349514, -.928995}}};
    for (const PoseOfJoints& c : cases) {
        const Pose flange = forward(c.arm.geometry, radians(c.degrees));
        expect_near(flange.shift, c.position, 0.001, c.arm.name);
        expect_near(column(flange, 2), c.z_axis, 1e-6, c.arm.name);
        const ArmAnswers answers = inverse(c.arm.geometry, flange);
        for (const ArmAnswer& answer : answers) {
            expect_near(forward(c.arm.geometry, answer.joints).shift, c.position, 0.001, c.arm.name);
        }
        EXPECT_TRUE(is_among(answers, radians(c.degrees), 1e-9)) << c.arm.name;
    }
}

TEST(Arm, FlangesXAxisIsWhereTheTablesSay) {
    const Joints bent = radians({30, -60, 80, 20, 45, -70});
    for (const NamedArm& arm : {kr_120_r2500_pro(), kr_60_ha()}) {
        expect_near(column(forward(arm.geometry, bent), 0), {.040830, .900541, -.432850}, 1e-6, arm.name);
    }
    const Pose flange = forward(irb_6640_185().geometry, radians({30, 20, 10, 20, 45, -70}));
    expect_near(column(flange, 0), {-.018804, -.934971, -.354226}, 1e-6, "IRB 6640");
}

TEST(Arm, EveryAnswerHoldsThePoseAndTheGeneratingJointsAreOneOfThem) {
    for (const NamedArm& arm : all_arms()) {
        std::mt19937 random(7);
        WorstErrors worst;
        std::size_t missing = 0;
        std::size_t answered = 0;
        std::size_t misnamed = 0;
        for (int i = 0; i < 100'000; ++i) {
            const Joints joints = random_joints(arm, random);
            const ArmConfiguration configuration = configuration_of(arm.geometry, joints);
            const Pose flange = forward(arm.geometry, joints);
            const ArmAnswers answers = inverse(arm.geometry, flange);
            const ArmAnswer* generating = nullptr;
            for (const ArmAnswer& answer : answers) {
                worst.add_pose(flange, forward(arm.geometry, answer.joints));
                misnamed += configuration_of(arm.geometry, answer.joints) == answer.configuration ? 0 : 1;
                if (answer.configuration == configuration) generating = &answer;
            }
            answered += answers.size();
            missing += generating == nullptr ? 1 : 0;
            if (generating != nullptr) {
                worst.joints = std::max(worst.joints, distance_modulo_turns(generating->joints, joints));
            }
        }
        EXPECT_EQ(missing, 0U) << arm.name;
        EXPECT_EQ(misnamed, 0U) << arm.name;
        EXPECT_GT(answered, 400'000U) << arm.name;
        EXPECT_LT(worst.position, 1e-6) << arm.name;
        EXPECT_LT(worst.rotation, 1e-9) << arm.name;
        EXPECT_LT(worst.joints, 1e-7) << arm.name;
    }
}

TEST(Arm, ConfigurationsOfAPoseDifferAndJointsAreWithinOneTurn) {
    std::mt19937 random(8);
    for (const NamedArm& arm : all_arms()) {
        const Pose flange = forward(arm.geometry, radians({10, -70, 100, 30, 60, 20}));
        const ArmAnswers answers = inverse(arm.geometry, flange, random_joints(arm, random));
        EXPECT_FALSE(answers.empty()) << arm.name;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            for (const double joint : answers[i].joints) EXPECT_LE(std::abs(joint), pi) << arm.name;
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_FALSE(answers[i].configuration == answers[j].configuration) << arm.name;
                EXPECT_GT(distance_modulo_turns(answers[i].joints, answers[j].joints), 1e-3) << arm.name;
            }
        }
    }
}

TEST(Arm, ConfigurationSaysWhereWristCentreElbowAndWristAre) {
    const NamedArm arm = kr_120_r2500_pro();
    const auto configuration = [&](const Joints& degrees) { return configuration_of(arm.geometry, radians(degrees)); };
    EXPECT_EQ(configuration({0, -90, 90, 0, 30, 0}), (ArmConfiguration{false, false, false}));
    EXPECT_EQ(configuration({0, -90, 90, 0, -30, 0}), (ArmConfiguration{false, false, true}));
    EXPECT_EQ(configuration({0, -30, -60, 0, 30, 0}), (ArmConfiguration{false, true, false}));
    EXPECT_EQ(configuration({0, -140, -60, 0, 30, 0}), (ArmConfiguration{true, true, false}));
}

TEST(Arm, UnreachablePosesHaveNoAnswer) {
    for (const NamedArm& arm : all_arms()) {
        EXPECT_TRUE(inverse(arm.geometry, {Pose{}.row, {20'000, 0, 500}}).empty()) << arm.name;
        EXPECT_TRUE(inverse(arm.geometry, {Pose{}.row, {0, 0, 1e200}}).empty()) << arm.name;
    }
    // Too near to axis 2: between the lengths of upper arm and forearm lie 149 mm.
    const ArmGeometry arm = kr_120_r2500_pro().geometry;
    const ArmAnswers behind = inverse(arm, {Pose{}.row, {350 + 100, 0, 675 + 215}});
    EXPECT_EQ(behind.size(), 4U);
    for (const ArmAnswer& answer : behind) EXPECT_TRUE(answer.configuration.is_back);
    // Nearer to axis 1 than the arm is offset.
    const ArmGeometry offset = offset_arm().geometry;
    EXPECT_TRUE(inverse(offset, {Pose{}.row, {119, 0, 2000}}).empty());
    EXPECT_FALSE(inverse(offset, {Pose{}.row, {121, 0, 2000}}).empty());
}

TEST(Arm, ReachEndsAtTheStretchedArm) {
    for (const NamedArm& arm : real_arms()) {
        const ArmGeometry& g = arm.geometry;
        const double stretched = g.c2 + std::hypot(g.a2, g.c3);
        const auto flange_at = [&](double distance) { return Pose{Pose{}.row, {g.a1 + distance, 0, g.c1 + g.c4}}; };
        const Pose flange = flange_at(stretched);
        const ArmAnswers answers = inverse(g, flange);
        ASSERT_EQ(answers.size(), 4U) << arm.name;
        for (const ArmAnswer& answer : answers) {
            const Pose held = forward(g, answer.joints);
            EXPECT_LT(norm(held.shift - flange.shift), 1e-6) << arm.name;
            EXPECT_LT(rotation_between(held, flange), 1e-9) << arm.name;
            EXPECT_NEAR(singularity(g, answer.joints).elbow, 0, 1e-12) << arm.name;
        }
        const Pose rounded = flange_at(stretched + 1e-8);
        EXPECT_EQ(inverse(g, rounded).size(), 4U) << arm.name;
        for (const ArmAnswer& answer : inverse(g, rounded)) {
            EXPECT_LT(norm(forward(g, answer.joints).shift - rounded.shift), 1e-6) << arm.name;
        }
        EXPECT_TRUE(inverse(g, flange_at(stretched + 1e-3)).empty()) << arm.name;
        // Where acos loses half of its digits, the pose is exact still.
        for (const double shorter : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
            const Pose near = flange_at(stretched - shorter);
            for (const ArmAnswer& answer : inverse(g, near)) {
                EXPECT_LT(norm(forward(g, answer.joints).shift - near.shift), 1e-9) << arm.name << " " << shorter;
            }
        }
    }
}

TEST(Arm, ValuesThatAreNotFiniteHaveNoAnswer) {
    const NamedArm arm = kr_120_r2500_pro();
    const Joints joints = radians({30, -60, 80, 20, 45, -70});
    const Pose flange = forward(arm.geometry, joints);
    for (const double bad : {nan, infinite, -infinite}) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                Pose pose = flange;
                pose.row[i][k] = bad;
                EXPECT_TRUE(inverse(arm.geometry, pose).empty());
            }
            Pose pose = flange;
            pose.shift[static_cast<int>(i)] = bad;
            EXPECT_TRUE(inverse(arm.geometry, pose).empty());
            EXPECT_TRUE(inverse_within(arm.geometry, arm.ranges, 0, pose).empty());
        }
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            Joints broken = joints;
            broken[axis] = bad;
            EXPECT_TRUE(inverse(arm.geometry, flange, broken).empty());
            EXPECT_TRUE(inverse(arm.geometry, forward(arm.geometry, broken)).empty());
            EXPECT_TRUE(turns_within(arm.ranges, 0, broken).empty());
            EXPECT_FALSE(is_within(arm.ranges, 0, broken));
            EXPECT_FALSE(joint_speeds(arm.geometry, broken, {}, {{1, 0, 0}, {}}));
            EXPECT_FALSE(largest_joint_speeds(arm.geometry, broken));
        }
        EXPECT_TRUE(inverse_within(arm.geometry, arm.ranges, std::abs(bad), flange).empty());
        EXPECT_TRUE(turns_within(arm.ranges, -std::abs(bad), joints).empty());
        EXPECT_FALSE(joint_speeds(arm.geometry, joints, {bad, 0, 0}, {{1, 0, 0}, {}}));
        EXPECT_FALSE(joint_speeds(arm.geometry, joints, {}, {{bad, 0, 0}, {}}));
        EXPECT_FALSE(joint_speeds(arm.geometry, joints, {}, {{}, {0, 0, bad}}));
    }
}

TEST(Arm, WristAtItsSingularityFollowsTheNeighbour) {
    for (const NamedArm& arm : real_arms()) {
        const Joints held = radians({20, -70, 60, 37, 0, 10});
        const Pose flange = forward(arm.geometry, held);
        const Joints neighbour = radians({0, 0, 0, 37 - 360, 0, 0});
        const ArmAnswers near = inverse(arm.geometry, flange, neighbour);
        EXPECT_TRUE(is_among(near, held, 1e-9)) << arm.name;
        const ArmAnswers far = inverse(arm.geometry, flange);
        EXPECT_TRUE(is_among(far, radians({20, -70, 60, 0, 0, 47}), 1e-9)) << arm.name;
        for (const ArmAnswers& answers : {near, far}) {
            for (const ArmAnswer& answer : answers) {
                const Pose again = forward(arm.geometry, answer.joints);
                EXPECT_LT(norm(again.shift - flange.shift), 1e-6) << arm.name;
                EXPECT_LT(rotation_between(again, flange), 1e-9) << arm.name;
            }
        }
    }
}

TEST(Arm, PoseIsExactHoweverNearTheWristIsToItsSingularity) {
    for (const NamedArm& arm : all_arms()) {
        for (const double angle : {1e-3, 1e-6, 1e-8, 1.1e-9, 0.9e-9, 1e-12}) {
            Joints joints = radians({20, -70, 60, 37, 0, 10});
            joints[4] = arm.geometry.sign[4] * (angle + arm.geometry.offset[4]);
            const Pose flange = forward(arm.geometry, joints);
            const ArmAnswers answers = inverse(arm.geometry, flange);
            EXPECT_GE(answers.size(), 4U) << arm.name;
            for (const ArmAnswer& answer : answers) {
                EXPECT_LT(rotation_between(forward(arm.geometry, answer.joints), flange), 1.5e-9)
                    << arm.name << " " << angle;
            }
        }
    }
}

TEST(Arm, ShoulderAtItsSingularityFollowsTheNeighbour) {
    const ArmGeometry arm = kr_120_r2500_pro().geometry;
    const Pose flange{Pose{}.row, {0, 0, 2200}};
    const ArmAnswers answers = inverse(arm, flange, radians({50, 0, 0, 0, 0, 0}));
    ASSERT_FALSE(answers.empty());
    for (const ArmAnswer& answer : answers) {
        const double expected = answer.configuration.is_back ? radians(-130) : radians(50);
        EXPECT_NEAR(std::remainder(answer.joints[0] - expected, full_turn), 0, 1e-12);
        EXPECT_LT(norm(forward(arm, answer.joints).shift - flange.shift), 1e-6);
        EXPECT_LT(singularity(arm, answer.joints).shoulder, 1e-6);
        EXPECT_FALSE(joint_speeds(arm, answer.joints, {0, 0, 300}, {{0, 10, 0}, {}}));
        EXPECT_FALSE(largest_joint_speeds(arm, answer.joints));
    }
}

TEST(Arm, AnswersWithinRangesAreThoseThatSomeTurnBringsThere) {
    for (const NamedArm& arm : all_arms()) {
        std::mt19937 random(9);
        std::size_t kept = 0;
        for (int i = 0; i < 2'000; ++i) {
            const double margin = radians(i % 2 == 0 ? 0 : 3);
            const Joints joints = random_joints(arm, random);
            const Joints neighbour = random_joints(arm, random);
            const Pose flange = forward(arm.geometry, joints);
            const ArmAnswers within = inverse_within(arm.geometry, arm.ranges, margin, flange, neighbour);
            std::size_t reachable = 0;
            for (const ArmAnswer& answer : inverse(arm.geometry, flange, neighbour)) {
                reachable += turns_within(arm.ranges, margin, answer.joints).empty() ? 0 : 1;
            }
            EXPECT_EQ(within.size(), reachable) << arm.name;
            for (const ArmAnswer& answer : within) {
                EXPECT_TRUE(is_within(arm.ranges, margin, answer.joints)) << arm.name;
                for (const Joints& turned : turns_within(arm.ranges, margin, answer.joints)) {
                    EXPECT_TRUE(is_within(arm.ranges, margin, turned)) << arm.name;
                    EXPECT_LT(distance_modulo_turns(turned, answer.joints), 1e-12) << arm.name;
                    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                        EXPECT_LE(std::abs(answer.joints[axis] - neighbour[axis]),
                                  std::abs(turned[axis] - neighbour[axis]) + 1e-12)
                            << arm.name;
                    }
                }
            }
            if (is_within(arm.ranges, margin, joints)) {
                EXPECT_TRUE(is_among(within, joints, 1e-6)) << arm.name;
            }
            kept += within.size();
        }
        EXPECT_GT(kept, 2'000U) << arm.name;
    }
}

TEST(Arm, EveryTurnOfEveryAxisInItsRangeIsListed) {
    JointRanges ranges = kr_120_r2500_pro().ranges;
    const Joints joints = radians({-178, -60, 80, 20, 45, -70});
    const std::vector<Joints> turned = turns_within(ranges, 0, joints);
    const std::vector<Joints> expected{radians({-178, -60, 80, -340, 45, -70}), radians({-178, -60, 80, -340, 45, 290}),
                                       radians({-178, -60, 80, 20, 45, -70}),   radians({-178, -60, 80, 20, 45, 290}),
                                       radians({182, -60, 80, -340, 45, -70}),  radians({182, -60, 80, -340, 45, 290}),
                                       radians({182, -60, 80, 20, 45, -70}),    radians({182, -60, 80, 20, 45, 290})};
    ASSERT_EQ(turned.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            EXPECT_NEAR(turned[i][axis], expected[i][axis], 1e-12) << i << " " << axis;
        }
    }
    EXPECT_EQ(turns_within(ranges, radians(5), joints).size(), 4U) << "182 degrees is outside of 185 less 5";
    EXPECT_EQ(turns_within(ranges, radians(7.5), joints).size(), 0U) << "-178 degrees too";
    EXPECT_TRUE(turns_within(ranges, radians(70), joints).empty()) << "nothing is left of the range of axis 2";
    ranges[5].max = infinite;
    EXPECT_TRUE(turns_within(ranges, 0, joints).empty());
}

TEST(Arm, TurnNearestToTheNeighbourIsGiven) {
    const NamedArm arm = kr_120_r2500_pro();
    const Joints joints = radians({30, -60, 80, 20, 45, -70});
    const Pose flange = forward(arm.geometry, joints);
    const auto given = [&](const Joints& neighbour) {
        const ArmAnswers answers = inverse_within(arm.geometry, arm.ranges, 0, flange, neighbour);
        for (const ArmAnswer& answer : answers) {
            if (answer.configuration == configuration_of(arm.geometry, joints)) return answer.joints;
        }
        return Joints{};
    };
    EXPECT_NEAR(given(joints)[3], radians(20), 1e-9);
    EXPECT_NEAR(given(joints)[5], radians(-70), 1e-9);
    EXPECT_NEAR(given(radians({30, -60, 80, -300, 45, 280}))[3], radians(-340), 1e-9);
    EXPECT_NEAR(given(radians({30, -60, 80, -300, 45, 280}))[5], radians(290), 1e-9);
    EXPECT_NEAR(given(radians({30, -60, 80, 349, 45, 1e6}))[3], radians(20), 1e-9) << "380 degrees are out of range";
    EXPECT_NEAR(given(radians({30, -60, 80, 349, 45, 1e6}))[5], radians(290), 1e-9);
}

TEST(Arm, SingularityMeasuresAreWhatTheyAreCalled) {
    for (const NamedArm& arm : real_arms()) {
        const ArmGeometry& g = arm.geometry;
        const double forearm = std::hypot(g.a2, g.c3);
        // Forearm at right angles to the upper arm: angle 3 plus the forearm's bend is 90 degrees.
        Joints joints{};
        const Joints angles{0, 0, pi / 2 - std::atan2(g.a2, g.c3), 0, pi / 6, 0};
        for (std::size_t i = 0; i < axes_of_arm; ++i) joints[i] = g.sign[i] * (angles[i] + g.offset[i]);
        const ArmSingularity nearness = singularity(g, joints);
        EXPECT_NEAR(nearness.wrist, 0.5, 1e-12) << arm.name;
        EXPECT_NEAR(nearness.shoulder, g.a1 + forearm, 1e-9) << arm.name;
        EXPECT_NEAR(nearness.elbow, 1 - std::hypot(g.c2, forearm) / (g.c2 + forearm), 1e-12) << arm.name;
    }
    const ArmGeometry offset = offset_arm().geometry;
    const ArmAnswers answers = inverse(offset, {Pose{}.row, {300, 400, 1800}});
    EXPECT_FALSE(answers.empty());
    for (const ArmAnswer& answer : answers) {
        EXPECT_NEAR(singularity(offset, answer.joints).shoulder, std::sqrt(500.0 * 500 - 120 * 120), 1e-6);
    }
}

}  // namespace
}  // namespace qchopper
