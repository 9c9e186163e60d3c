// Rounding of corners and feeds by the foam that is cut: bounds that hold for random runs.

#include "cam/toolpath/run_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace qchopper {
namespace {

class RandomRuns {
 public:
    double number(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }
    Vec3 point() { return {number(-50, 50), number(-50, 50), number(-50, 50)}; }
    PathRun run(std::size_t moves) {
        PathRun made{point(), {}};
        Vec3 at = made.start;
        for (std::size_t i = 0; i < moves; ++i) {
            at = at + number(0.1, i % 7 == 0 ? 60 : 4) * normalized(point());
            made.moves.push_back({at, i % 11 == 0 ? MoveKind::approach : MoveKind::cut});
        }
        return made;
    }

 private:
    std::mt19937 random_{3};
};

CuttingTool tool_of(double diameter, double rate) {
    CuttingTool tool;
    tool.diameter = diameter;
    tool.feed_min_mm_per_s = 1;
    tool.feed_max_mm_per_s = 150;
    tool.removal_mm3_per_s = rate;
    return tool;
}

// The parabola is looked at in many places, and held against the corner in the plainest way.
TEST(RunMotion, ACornerIsPassedWithinTheDeviation) {
    RandomRuns random;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 from = random.point();
        const Vec3 at = random.point();
        const Vec3 to = random.point();
        const double deviation = random.number(0.01, 1);
        const double rounding = corner_rounding(from, at, to, deviation, 5);
        ASSERT_GT(rounding, 0);
        ASSERT_LE(rounding, 5);
        double nearest = 1e9;
        for (int k = 0; k <= 200; ++k)
            nearest = std::min(nearest, norm(on_parabola(from, at, to, rounding, k / 200.0) - at));
        EXPECT_LE(nearest, deviation + 1e-9);
        // It is the largest one: a tenth more would pass farther from the corner, unless the lengths bound it.
        const double beyond = norm(on_parabola(from, at, to, 1.1 * rounding, 0.5) - at);
        EXPECT_TRUE(rounding == 5 || beyond > deviation) << beyond;
    }
    EXPECT_EQ(corner_rounding({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, 0.1, 5), 0);
}

// The rate of every way as long as the tool is wide, computed by adding up; only the least feed may exceed it.
TEST(RunMotion, NoWayIsMilledFasterThanTheToolMay) {
    RandomRuns random;
    for (int n = 0; n < 40; ++n) {
        PathRun run = random.run(300);
        const CuttingTool tool = tool_of(random.number(4, 30), 20000);
        Operation operation;
        operation.feed = 150;
        operation.approach_feed = 75;
        operation.link_feed = 300;
        std::vector<double> removed;
        std::vector<double> length;
        Vec3 at = run.start;
        for (const PathMove& move : run.moves) {
            length.push_back(norm(move.tip - at));
            removed.push_back(length.back() * random.number(0, 400));
            at = move.tip;
        }
        limit_feeds(run, removed, 0.5, tool, operation);
        std::size_t slowed = 0;
        for (std::size_t last = 0; last < run.moves.size(); ++last) {
            double mm = 0;
            double mm3 = 0;
            double seconds = 0;
            for (std::size_t i = last + 1; i-- > 0 && mm < tool.diameter;) {
                const PathMove& move = run.moves[i];
                const double own = move.kind == MoveKind::cut ? operation.feed : operation.approach_feed;
                ASSERT_LT(move.feed, own);
                if (move.feed > 0) ++slowed;
                mm += length[i];
                mm3 += removed[i];
                seconds += length[i] / (move.feed > 0 ? move.feed : own);
            }
            EXPECT_LE(mm3 / seconds, used_rate * (1 - 0.5 / tool.diameter) * tool.removal_mm3_per_s * (1 + 1e-9));
        }
        EXPECT_GT(slowed, 0U);
    }
}

// Short lines through a full slot, at a feed a little above the least: none of them makes up for a faster one.
TEST(RunMotion, ShortLinesOfOneSectionHaveOneFeed) {
    PathRun run{{0, 0, 0}, {}};
    std::vector<double> removed;
    for (int i = 1; i <= 30; ++i) {
        run.moves.push_back({{5.0 * i, 0, 0}});
        removed.push_back(5 * 700.0);
    }
    CuttingTool tool = tool_of(20, 24000);
    tool.feed_min_mm_per_s = 20;
    Operation operation;
    operation.feed = 150;
    limit_feeds(run, removed, 0, tool, operation);
    for (std::size_t i = 4; i < run.moves.size(); ++i) {
        EXPECT_LE(run.moves[i].feed, used_rate * 24000 / 700 * (1 + 1e-9)) << i;
        EXPECT_GE(run.moves[i].feed, 20) << i;
    }
}

// Lines of a piece of the bunny. The proof drives a rounded corner with the move before it: a half of the last move.
TEST(RunMotion, FoamInARoundedCornerCountsForBothMoves) {
    PathRun run{{0, 0, 0}, {{{11, 0, 0}}, {{19, 0, 0}}, {{27, 0, 0}}}};
    run.moves[0].rounding = 0.8;
    run.moves[1].rounding = 5;
    const std::vector<double> removed{2, 144, 212};
    CuttingTool tool = tool_of(6, 1500);
    tool.feed_min_mm_per_s = 10;
    Operation operation;
    operation.feed = 60;
    limit_feeds(run, removed, 0.5, tool, operation);
    const double rate = used_rate * (1 - 0.5 / 6) * 1500;
    const double with_corners = (1 - 0.8 / 8) * removed[1] + 0.5 * removed[2];
    EXPECT_LE(with_corners * run.moves[1].feed / 8, rate * (1 + 1e-9));
    EXPECT_LE(removed[2] * run.moves[2].feed / 8, rate * (1 + 1e-9));
    EXPECT_GT(with_corners * run.moves[1].feed / 8, 0.8 * rate);
    EXPECT_GT(removed[2] * run.moves[2].feed / 8, 0.8 * rate);
    EXPECT_EQ(run.moves[0].feed, 0);
}

TEST(RunMotion, ALightCutKeepsTheFullFeedAndAHeavyOneNoLessThanTheLeast) {
    PathRun run{{0, 0, 0}, {{{50, 0, 0}}, {{100, 0, 0}}, {{150, 0, 0}}}};
    CuttingTool tool = tool_of(20, 24000);
    tool.feed_min_mm_per_s = 20;
    Operation operation;
    operation.feed = 150;
    limit_feeds(run, std::vector<double>{50 * 10.0, 50 * 400.0, 50 * 5000.0}, 0, tool, operation);
    EXPECT_EQ(run.moves[0].feed, 0);
    EXPECT_LE(run.moves[1].feed, used_rate * 24000 / 400);
    EXPECT_GT(run.moves[1].feed, 0.8 * used_rate * 24000 / 400);
    EXPECT_EQ(run.moves[2].feed, 20);
}

TEST(RunMotion, FewDistancesAreStatedAndNoneAboveWhatACornerAllows) {
    RandomRuns random;
    PathRun run = random.run(500);
    std::vector<double> allowed;
    for (PathMove& move : run.moves) {
        move.rounding = random.number(0, 1) < 0.2 ? 0 : random.number(0.06, 5);
        allowed.push_back(move.rounding);
    }
    run.moves.back().rounding = 0;
    allowed.back() = 0;
    settle_rounding(run, 5);
    std::size_t changes = 0;
    double before = 0;
    for (std::size_t i = 0; i < run.moves.size(); ++i) {
        const double own = run.moves[i].rounding;
        EXPECT_LE(own, allowed[i]);
        EXPECT_EQ(own > 0, allowed[i] > 0) << i;
        if (own > 0 && own != before) ++changes;
        if (own > 0) before = own;
    }
    EXPECT_LT(changes, 200U);
}

}  // namespace
}  // namespace qchopper
