// Entered values in the program of a box, which is quick to replay: on a fixed table and on a rotary table.

#include <gtest/gtest.h>

#include <algorithm>

#include "app/jobs/entered/entered_replay.h"
#include "app/jobs/job_scene.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"
#include "sim/replay/replay.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

constexpr std::uint16_t tool = 2;  // which both chunks use

struct EnteredBox : ::testing::TestWithParam<const char*> {
    BoxJob box = box_job(GetParam());
    qchopper::Setup setup;  // not ::testing::Test::Setup
    JobProgram stated;
    std::map<std::string, std::string> texts;
    Cell entered;

    EnteredBox() {
        const bool turns = box.cell.machine->rotary_table.has_value();
        if (turns) setup.placement.table_angles = {box.job.orientations[0].table_angle};
        for (const SceneChunk& chunk : chunks_of(box.job)) {
            stated.chunks.push_back({chunk.name + ".src", chunk.tool, 0, 0, 0, {}, {}, {}});
        }
    }
    ProofInput input() const {
        return {box.cell, setup, {box.job.orientations[0].setup_in_cell}, box.target, stated, texts};
    }
    EnteredBase moved(Vec3 shift, Vec3 abc_deg = {}) const {
        const Pose base = planned_base(box.cell, setup, input().setup_in_cell);
        const KukaAngles abc = kuka_angles(base);
        return {base.shift + shift, Vec3{degrees(abc.a), degrees(abc.b), degrees(abc.c)} + abc_deg};
    }
    double planned_length() const {
        return gauge_length(*std::ranges::find(box.cell.machine->tools, tool, &CuttingTool::number));
    }
    // Where only the program, or program and scene have the values.
    ReplayReport replayed(const EnteredValues& values, bool in_scene = true) {
        ReplayOptions options;
        options.cell = 0.5;
        options.volume_cell = 1;
        options.leftover.reach_cell = 0.5;
        options.leftover.sample_mm = 4;
        ParsedProgram program = read_back(box, box.files());
        ReplayScene scene = box.scene();
        entered = cell_with(values, box.cell);
        if (!values.is_empty()) enter_in_program(values, input(), program);
        if (!values.is_empty() && in_scene) enter_in_scene(values, input(), entered, scene);
        return replay(program, scene, options);
    }
};

std::string findings_of(const ReplayReport& report) {
    std::string text;
    for (const Finding& finding : report.findings)
        text += std::string(to_word(finding.kind)) + " " + finding.text + "\n";
    return text;
}

std::size_t count(const ReplayReport& report, FindingKind kind) {
    return report.counts[static_cast<std::size_t>(kind)];
}

TEST_P(EnteredBox, ThePlannedValuesChangeNothing) {
    const ReplayReport plain = replayed({});
    EXPECT_TRUE(plain.is_good) << findings_of(plain);
    const ReplayReport same = replayed({moved({}), {{tool, planned_length()}}});
    EXPECT_TRUE(same.is_good) << findings_of(same);
    EXPECT_EQ(same.largest_gouge, plain.largest_gouge);
    EXPECT_EQ(same.leftover.largest, plain.leftover.largest);
    EXPECT_EQ(same.time.seconds, plain.time.seconds);
    EXPECT_EQ(same.milling.removed_mm3, plain.milling.removed_mm3);
}

TEST_P(EnteredBox, IsProvenWithinTheLimits) {
    const ReplayReport plain = replayed({});
    const auto expect_good = [&](const EnteredValues& values) {
        const ReplayReport report = replayed(values);
        EXPECT_TRUE(report.is_good) << findings_of(report);
        EXPECT_NEAR(report.largest_gouge, plain.largest_gouge, 0.02);
        EXPECT_NEAR(report.milling.removed_mm3, plain.milling.removed_mm3, 1e-3 * plain.milling.removed_mm3);
        EXPECT_NE(report.time.seconds, plain.time.seconds);
    };
    expect_good({moved({12, -8, 4}, {0.4, 0.2, -0.2}), {}});
    expect_good({moved({-12, 10, 12}, {-0.6, -0.4, 0.5}), {}});
    expect_good({std::nullopt, {{tool, planned_length() + 1.5}}});
    expect_good({std::nullopt, {{tool, planned_length() - 1.5}}});
    expect_good({moved({0, 15, 0}, {0, 0.5, 0}), {{tool, planned_length() + 1.5}}});
}

TEST_P(EnteredBox, ABaseSoLowThatTheToolMeetsTheTableIsFound) {
    const ReplayReport report = replayed({moved({0, 0, -12}), {}});
    EXPECT_GT(count(report, FindingKind::collision), 0U) << findings_of(report);
}

TEST_P(EnteredBox, ValuesThatOnlyTheProgramHasAreFound) {
    const ReplayReport base = replayed({moved({15, 0, 0}), {}}, false);
    EXPECT_GT(count(base, FindingKind::base_frame), 0U);
    EXPECT_GT(base.largest_gouge, 5) << findings_of(base);
    const ReplayReport longer = replayed({std::nullopt, {{tool, planned_length() - 1.5}}}, false);
    EXPECT_GT(count(longer, FindingKind::tool_frame), 0U);
    EXPECT_NEAR(longer.largest_gouge, 1.5, 0.1) << findings_of(longer);
}

TEST_P(EnteredBox, TheLineBehindAJointMoveMustBeInAir) {
    // The joint moves end above the block as planned, which is 28 mm higher than the block: here they end in it.
    box.block.max.z += 24;
    const ReplayReport plain = replayed({});
    const ReplayReport higher = replayed({moved({0, 0, 15}, {0, 0.9, 0}), {}});
    EXPECT_GT(count(higher, FindingKind::rapid_in_foam), count(plain, FindingKind::rapid_in_foam))
        << findings_of(plain) << findings_of(higher);
}

TEST_P(EnteredBox, AnotherFrameThanThePlannedOneStays) {
    ParsedProgram program = read_back(box, box.files());
    for (ModalState& state : program.states) {
        if (state.base) state.base->shift.x += 0.1;
        if (state.tool) state.tool->shift.z += 0.1;
    }
    const std::vector<ModalState> before = program.states;
    enter_in_program({moved({1, 2, 3}), {{tool, planned_length() + 1}}}, input(), program);
    EXPECT_EQ(program.states, before);
}

TEST_P(EnteredBox, ToolsStayConsistent) {
    const Cell longer = cell_with({std::nullopt, {{tool, planned_length() + 1.5}}}, box.cell);
    const auto changed = std::ranges::find(longer.machine->tools, tool, &CuttingTool::number);
    EXPECT_NEAR(gauge_length(*changed), planned_length() + 1.5, 1e-9);
    EXPECT_EQ(longer.machine->tools[0], box.cell.machine->tools[0]);
    box.cell.machine->tools[1].flute_length = box.cell.machine->tools[1].stick_out;
    const Cell shorter = cell_with({std::nullopt, {{tool, planned_length() - 1.5}}}, box.cell);
    EXPECT_EQ(shorter.machine->tools[1].flute_length, shorter.machine->tools[1].stick_out);
}

INSTANTIATE_TEST_SUITE_P(Tables, EnteredBox, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"),
                         [](const auto& cell) {
                             return std::string(cell.param).substr(0, cell.param[2] == '6' ? 4 : 5);
                         });

}  // namespace
}  // namespace qchopper
