#include "sim/replay/replay.h"

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(Cells, Replay, testing::Values("kr60-ha", "kr120-r2500-pro-rotary"),
                         [](const auto& tested) { return tested.param == "kr60-ha" ? "Fixed" : "Rotary"; });

}  // namespace
}  // namespace qchopper
