// What stands for left-out cuts holds all that they would have removed, and slows the moves that come near, no others.

#include "cam/program/left_out_foam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace qchopper {
namespace {

constexpr double retract = 100;

TEST(LeftOutFoam, BodiesHoldAllThatTheCutWouldHaveRemoved) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const Vec3 axis = normalized(Vec3{0.3, -0.2, 1});
    const Vec3 across = normalized(cross(axis, Vec3{1, 0, 0}));
    const Vec3 beside = cross(axis, across);
    for (const double length : {0.0, 3.0, 57.0}) {
        const Vec3 from{10, 20, -5};
        const Vec3 to = from + length * normalized(Vec3{1, 2, 0.1});
        const std::vector<Capsule> bodies = bodies_of_cut(from, to, axis, 10, retract);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 tip = from + unit(random) * (to - from);
            const double r = 10 * unit(random);
            const double angle = 7 * unit(random);
            const double height = unit(random) * (retract - dot(axis, tip));
            const Vec3 p = tip + height * axis + r * std::cos(angle) * across + r * std::sin(angle) * beside;
            const bool is_in = std::any_of(bodies.begin(), bodies.end(), [&](const Capsule& body) {
                return distance(Capsule{p, p, 0}, body) <= 1e-9;
            });
            ASSERT_TRUE(is_in) << length << ": " << p.x << " " << p.y << " " << p.z;
        }
    }
}

TEST(LeftOutFoam, SlowsMovesThatMayMeetItAndNoOthers) {
    CuttingTool tool;
    tool.diameter = 20;
    tool.feed_min_mm_per_s = 20;
    const std::vector<Capsule> bodies = bodies_of_cut({0, 0, 0}, {10, 0, 0}, {0, 0, 1}, 10, retract);
    ProgramOperation operation;
    operation.tool_axis = {0, 0, 1};
    ProgramRun run;
    run.start = {-100, 0, retract};
    const auto to = [&](Vec3 tip, MoveKind kind) {
        ProgramMove move;
        move.tip = tip;
        move.kind = kind;
        move.speed = kind == MoveKind::cut ? 100 : 300;
        run.moves.push_back(move);
    };
    to({-100, 0, 20}, MoveKind::link);
    to({100, 0, 20}, MoveKind::link);  // through it
    to({100, 32, 20}, MoveKind::link);
    to({-100, 32, 20}, MoveKind::link);  // 12 mm beside the foam, of which the bodies tell 9.6
    to({-100, 0, 20}, MoveKind::cut);
    to({0, 0, 20}, MoveKind::cut);  // into it, as a cut
    to({0, 0, retract}, MoveKind::retract);
    operation.runs.push_back(run);
    EXPECT_EQ(slow_moves_near(bodies, tool, retract, operation), 2U);
    const std::vector<ProgramMove>& moves = operation.runs[0].moves;
    EXPECT_EQ(moves[0].speed, 300);
    EXPECT_EQ(moves[1].speed, 20);
    EXPECT_EQ(moves[2].speed, 300);
    EXPECT_EQ(moves[3].speed, 300);
    EXPECT_EQ(moves[4].speed, 100);
    EXPECT_EQ(moves[5].speed, 20) << "a cut removes what stays";
    EXPECT_EQ(moves[6].speed, 300) << "straight up, where the tool is already";
    ProgramOperation other = operation;
    EXPECT_EQ(slow_moves_near({}, tool, retract, other), 0U);
    EXPECT_EQ(other, operation);
}

}  // namespace
}  // namespace qchopper
