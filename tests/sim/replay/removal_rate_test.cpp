// The rate at which foam is removed, on lines whose foam is given.

#include "sim/replay/removal_rate_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace qchopper {
namespace {

const Cell& kr60() {
    static const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    return cell;
}

struct GivenCut {
    double mm = 0;
    double mm3 = 0;
    double feed = 100;
    bool follows = true;
    std::uint32_t tool = 1;  // the flat end of 20 mm, 24,000 mm3/s
};

std::size_t findings(const std::vector<GivenCut>& given) {
    ToolPath path;
    std::vector<LineCut> cuts;
    Vec3 at;
    for (const GivenCut& one : given) {
        TipLine line;
        line.from = at;
        at.x += one.mm;
        line.to = at;
        line.feed = one.feed;
        line.tool = one.tool;
        line.follows_line = one.follows;
        path.lines.push_back(line);
        cuts.push_back({one.mm3 > 0, one.mm3});
    }
    ReplayScene scene;
    scene.cell = &kr60();
    FindingLog log;
    check_removal_rate(path, cuts, scene, log);
    return log.count(FindingKind::removal_rate);
}

TEST(RemovalRate, IsThatOfAWayAsLongAsTheToolIsWide) {
    // 100 mm/s through 240 mm2 are 24,000 mm3/s.
    EXPECT_EQ(findings({{100, 100 * 240.0}}), 0U);
    EXPECT_EQ(findings({{100, 100 * 262.0}}), 0U) << "within the tolerance";
    EXPECT_EQ(findings({{100, 100 * 266.0}}), 1U);
    EXPECT_EQ(findings({{100, 100 * 266.0, 90}}), 0U) << "slower";
    // A short line may remove much between two that remove little.
    EXPECT_EQ(findings({{9, 0}, {2, 1000}, {9, 0}}), 0U);
    std::vector<GivenCut> many(50, {1, 266});
    many.front().follows = false;
    EXPECT_EQ(findings(many), 31U) << "every line from the twentieth on";
}

TEST(RemovalRate, BeginsAnewWhereALineFollowsNoneAndAtAnotherTool) {
    std::vector<GivenCut> cuts(19, {1, 1000, 100, false});
    EXPECT_EQ(findings(cuts), 0U) << "each is shorter than the tool is wide";
    EXPECT_EQ(findings({{15, 9000}, {15, 9000, 100, true, 0}}), 0U);
    EXPECT_EQ(findings({{15, 9000}, {15, 9000}}), 1U);
}

TEST(RemovalRate, IsNotAskedOfDrills) {
    EXPECT_EQ(findings({{50, 50 * 266.0, 100, true, 4}}), 0U);
}

}  // namespace
}  // namespace qchopper
