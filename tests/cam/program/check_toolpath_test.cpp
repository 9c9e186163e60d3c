// Toolpaths at the bounds of what a machine may run; make_program_test.cpp asks how refusals read.

#include "cam/program/check_toolpath.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "base/error.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

class CheckToolpath : public testing::Test {
 protected:
    // Whether the toolpath is taken once its first operation was changed.
    bool takes(const std::function<void(Operation&, const CuttingTool&)>& change) const {
        Toolpath toolpath = job.toolpath;
        Operation& operation = toolpath.operations.front();
        change(operation, job.cell.machine->tools[operation.tool]);
        try {
            check_toolpath(toolpath, job.setup, job.cell);
        } catch (const InputError&) {
            return false;
        }
        return true;
    }

    const test_programs::Job job =
        test_programs::job_in(test_programs::ready_cell("kr60-ha.toml"), {250, 200, 150}, 35, 200, 15);
};

TEST_F(CheckToolpath, TheWindowsOfAToolHoldTheirBounds) {
    EXPECT_TRUE(takes([](Operation&, const CuttingTool&) {}));
    EXPECT_TRUE(takes([](Operation& o, const CuttingTool& tool) { o.feed = tool.feed_max_mm_per_s; }));
    EXPECT_TRUE(takes([](Operation& o, const CuttingTool& tool) { o.feed = tool.feed_min_mm_per_s; }));
    EXPECT_TRUE(takes([](Operation& o, const CuttingTool& tool) { o.rpm = tool.rpm_min; }));
    EXPECT_FALSE(takes([](Operation& o, const CuttingTool& tool) { o.feed = 1.001 * tool.feed_max_mm_per_s; }));
    EXPECT_FALSE(takes([](Operation& o, const CuttingTool& tool) { o.feed = 0.999 * tool.feed_min_mm_per_s; }));
    EXPECT_FALSE(takes([](Operation& o, const CuttingTool& tool) { o.rpm = 0.999 * tool.rpm_min; }));
    EXPECT_FALSE(takes([](Operation& o, const CuttingTool& tool) { o.rpm = 1.001 * tool.rpm_max; }));
    EXPECT_FALSE(takes([](Operation& o, const CuttingTool&) { o.rpm = std::numeric_limits<double>::quiet_NaN(); }));
}

TEST_F(CheckToolpath, NoCoordinateIsFartherThan5Metres) {
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_TRUE(takes([&](Operation& o, const CuttingTool&) { o.runs[0].start.y = sign * 4999; }));
        EXPECT_FALSE(takes([&](Operation& o, const CuttingTool&) { o.runs[0].start.y = sign * 5000; }));
        EXPECT_FALSE(takes([&](Operation& o, const CuttingTool&) { o.runs[0].moves[0].tip.z = sign * 5000; }));
    }
}

}  // namespace
}  // namespace qchopper
