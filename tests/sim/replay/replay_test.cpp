#include "sim/replay/replay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cam/cell/machine_bodies.h"
#include "cam/cell/reach_map.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

std::string findings_of(const ReplayReport& report) {
    std::string text;
    for (const Finding& finding : report.findings)
        text += std::string(to_word(finding.kind)) + " " + finding.text + "\n";
    return text;
}

ReplayOptions coarse() {
    ReplayOptions options;
    options.cell = 0.5;
    return options;
}

class Replay : public testing::TestWithParam<std::string> {};

TEST_P(Replay, AGoodProgramHasNoFindings) {
    const BoxJob job = box_job(GetParam());
    const ReplayReport report = replay(read_back(job, job.files()), job.scene(), coarse());
    EXPECT_TRUE(report.is_good) << findings_of(report);
    EXPECT_LE(report.largest_gouge, 0.02);
    EXPECT_GT(report.share_reachable(), 0.99);
    EXPECT_GE(report.share_within(), 0.995);
    EXPECT_GT(report.milling.removed_mm3, 1e4);
}

// The capsule of the wrist is about the tool axis: its rounded end reaches down around the spindle.
TEST_P(Replay, TheWristIsKeptOutOfTheFoamAsTheSpindleIs) {
    for (const auto& [above_tip, is_in] : {std::pair(17.0, true), std::pair(32.0, false)}) {
        BoxJob job = box_job(GetParam());
        Robot& robot = *job.cell.machine->robot;
        // Nothing but a thin spindle is below the wrist.
        job.cell.machine->tools[1].holder.clear();
        job.cell.machine->tools[1].stick_out = 12;
        job.cell.machine->spindle.body_radius = 5;
        const ToolArm arm = tool_arm(robot, job.cell.machine->spindle, job.cell.machine->tools[1]);
        const double down = arm.tip_in_flange.shift.z - above_tip;  // from the flange, where the capsule ends
        ASSERT_TRUE(is_about_tool_axis(robot.capsules[2], robot, job.cell.machine->spindle));
        robot.capsules[2].shape.radius = std::hypot(down, job.cell.machine->spindle.body_radius);
        const ReplayReport report = replay(read_back(job, job.files()), job.scene(), coarse());
        const std::size_t contacts = report.counts[static_cast<std::size_t>(FindingKind::holder_contact)];
        EXPECT_EQ(contacts > 0, is_in) << above_tip;
        EXPECT_EQ(findings_of(report).find("the wrist comes") != std::string::npos, is_in) << above_tip << "\n"
                                                                                           << findings_of(report);
    }
}

// The block as it stands before the program; the wrist is left to the test above.
TEST_P(Replay, LinksAreKeptOffTheWholeBlock) {
    BoxJob job = box_job(GetParam());
    job.block.max.z = 900;
    const ReplayReport report = replay(read_back(job, job.files()), job.scene(), coarse());
    EXPECT_NE(findings_of(report).find(" meets the block"), std::string::npos) << findings_of(report);
}

INSTANTIATE_TEST_SUITE_P(Cells, Replay, testing::Values("kr60-ha", "kr120-r2500-pro-rotary"),
                         [](const auto& tested) { return tested.param == "kr60-ha" ? "Fixed" : "Rotary"; });

}  // namespace
}  // namespace qchopper
