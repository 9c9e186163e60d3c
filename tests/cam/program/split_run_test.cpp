// What is divided is still there, in its order.

#include "cam/program/split_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cam/program/sampled_path.h"

namespace qchopper {
namespace {

const Vec3 tilted = normalized({0.3, -0.2, 0.9});

PathRun random_run(std::mt19937& random, std::size_t moves) {
    const auto number = [&] { return std::uniform_real_distribution<double>(-100, 100)(random); };
    PathRun run{{number(), number(), 300}, {}};
    for (std::size_t i = 0; i < moves; ++i) {
        const int kind = std::uniform_int_distribution<int>(0, 9)(random);
        const MoveKind what = i == 0 ? MoveKind::approach : kind == 0 ? MoveKind::link : MoveKind::cut;
        run.moves.push_back({{number(), number(), number()}, what, kind > 2 ? 1.0 : 0.0});
    }
    run.moves.push_back({{number(), number(), 300}, MoveKind::retract, false});
    return run;
}

TEST(SplitRun, RetractsAndComesBack) {
    std::mt19937 random(1);
    const PathRun run = random_run(random, 12);
    for (std::size_t count = 1; count < run.moves.size(); ++count) {
        const auto [head, tail] = split_run(run, count, tilted, 400);
        EXPECT_EQ(head.start, run.start);
        EXPECT_EQ(head.moves.size() + tail.moves.size(), run.moves.size() + 3);
        EXPECT_EQ(head.moves[count - 1].rounding, 0);
        EXPECT_EQ(head.moves.back().kind, MoveKind::retract);
        EXPECT_NEAR(dot(tilted, head.moves.back().tip), 400, 1e-9);
        EXPECT_NEAR(norm(cross(tilted, head.moves.back().tip - run.moves[count - 1].tip)), 0, 1e-9);
        EXPECT_EQ(tail.start, head.moves.back().tip);
        const Vec3 tip = run.moves[count - 1].tip;
        EXPECT_EQ(tail.moves[0], (PathMove{tip + 5.0 * tilted, MoveKind::link, false}));
        EXPECT_EQ(tail.moves[1], (PathMove{tip, MoveKind::approach, false}));
    }
}

TEST(SplitRun, KeepsRunsUnderTheirLines) {
    std::mt19937 random(2);
    for (int i = 0; i < 50; ++i) {
        const PathRun run = random_run(random, 400);
        const std::size_t lines = std::uniform_int_distribution<std::size_t>(12, 600)(random);
        const std::vector<PathRun> parts = split_long_runs({run, run}, lines, tilted, 400);
        std::vector<Vec3> tips;
        for (const PathRun& part : parts) {
            EXPECT_LE(lines_of(part), lines);
            for (const PathMove& move : part.moves) {
                if (move.kind == MoveKind::cut) tips.push_back(move.tip);
            }
        }
        std::vector<Vec3> expected;
        for (int twice = 0; twice < 2; ++twice) {
            for (const PathMove& move : run.moves) {
                if (move.kind == MoveKind::cut) expected.push_back(move.tip);
            }
        }
        EXPECT_EQ(tips, expected);
    }
}

TEST(SampledPath, HasEveryEndAndNoLongStep) {
    std::mt19937 random(3);
    const std::vector<PathRun> runs{random_run(random, 5), random_run(random, 1), random_run(random, 9)};
    const SampledPath path = sampled_path(runs);
    ASSERT_EQ(path.first.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(path.region.poses[path.first[i]].tip, runs[i].start);
        EXPECT_EQ(path.region.poses[path.last[i]].tip, runs[i].moves.back().tip);
    }
    for (std::size_t i = 1; i < path.region.poses.size(); ++i) {
        EXPECT_LE(norm(path.region.poses[i].tip - path.region.poses[i - 1].tip), longest_sample_step + 1e-9);
        EXPECT_EQ(path.region.poses[i].beside, i - 1);
    }
    EXPECT_EQ(path.runs_within(path.last[0]), 0U);
    EXPECT_EQ(path.runs_within(path.last[0] + 1), 1U);
    EXPECT_EQ(path.runs_within(path.poses()), 3U);
}

}  // namespace
}  // namespace qchopper
