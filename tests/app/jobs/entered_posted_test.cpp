// Entered values in programs as they are posted for the ready cells: the tip goes the same way in the block, and
// nothing that is stated is wrong.

#include <gtest/gtest.h>

#include <algorithm>

#include "app/jobs/entered/entered_replay.h"
#include "app/jobs/job_scene.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"
#include "cam/post/post.h"
#include "sim/replay/read_program.h"
#include "sim/replay/walk/machine_walk.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using test_programs::Job;

constexpr double near_mm = 0.01;  // frames are written with three decimals and four

// One toolpath of two tools and two orientations, posted for a cell.
struct Posted {
    Job job;
    std::vector<ProgramFile> files;
    JobProgram stated;
    std::map<std::string, std::string> texts;
    std::vector<Pose> frames;
    TriangleMesh none;

    explicit Posted(const std::string& cell)
        : job(test_programs::job_in(test_programs::ready_cell(cell + ".toml"), {250, 200, 150}, 15, 40)) {
        const auto parts = post_program(test_programs::program_of(job), job.cell, {7});
        EXPECT_EQ(parts.size(), 1U);
        for (const ProgramText& file : parts[0].files) files.push_back({file.name, file.text});
        for (const PostedChunk& chunk : parts[0].chunks) {
            stated.chunks.push_back({chunk.name, chunk.tool_number, chunk.orientation, 0, 0, {}, {}, {}});
        }
        for (std::size_t d = 0; d < job.setup.access.orientations.size(); ++d) {
            frames.push_back(setup_in_cell(job.cell, job.setup.spoil, job.setup.placement, d));
        }
    }
    ProofInput input() const { return {job.cell, job.setup, frames, none, stated, texts}; }
    ParsedProgram read() const { return read_program(job.cell.machine->program.dialect, files, "qc_7", job.cell); }
    ReplayScene scene() const {
        ReplayScene scene;
        scene.cell = &job.cell;
        for (std::size_t d = 0; d < frames.size(); ++d) {
            scene.orientations.push_back(
                {normalized(job.setup.tool_axis(d)), job.setup.placement.table_angle(d), frames[d]});
        }
        for (const JobChunk& chunk : stated.chunks) {
            scene.chunks.push_back({chunk.file.substr(0, chunk.file.find('.')), chunk.tool, chunk.orientation});
        }
        scene.block = job.setup.block_box();
        scene.spoil = job.setup.spoil;
        return scene;
    }
    EnteredBase moved(Vec3 shift, Vec3 abc_deg) const {
        const Pose base = planned_base(job.cell, job.setup, frames);
        const KukaAngles abc = kuka_angles(base);
        return {base.shift + shift, Vec3{degrees(abc.a), degrees(abc.b), degrees(abc.c)} + abc_deg};
    }
    std::vector<EnteredLength> lengths(double longer) const {
        std::vector<EnteredLength> all;
        for (const CuttingTool& tool : job.cell.machine->tools) {
            all.push_back({tool.number, gauge_length(tool) + longer});
        }
        return all;
    }
};

struct Walked {
    FindingLog log;
    ToolPath path;
};

Walked walked(const ParsedProgram& program, const ReplayScene& scene) {
    Walked walk;
    walk.path = walk_machine(program, scene, walk.log, {});
    return walk;
}

void expect_stated_right(const FindingLog& log) {
    for (const Finding& finding : log.findings()) {
        const bool is_of_statement = finding.kind == FindingKind::base_frame ||
                                     finding.kind == FindingKind::tool_frame || finding.kind == FindingKind::load ||
                                     finding.kind == FindingKind::tool_axis ||
                                     finding.kind == FindingKind::tool_change || finding.kind == FindingKind::not_home;
        EXPECT_FALSE(is_of_statement) << to_word(finding.kind) << ": " << finding.text;
    }
}

double farthest(const ToolPath& a, const ToolPath& b) {
    EXPECT_EQ(a.lines.size(), b.lines.size());
    double most = 0;
    for (std::size_t i = 0; i < std::min(a.lines.size(), b.lines.size()); ++i) {
        most = std::max(most, norm(a.lines[i].to - b.lines[i].to));
    }
    return most;
}

struct EnteredPosted : ::testing::TestWithParam<const char*> {
    Posted posted{GetParam()};
};

TEST_P(EnteredPosted, TheTipGoesTheSameWayInTheBlock) {
    const Walked plain = walked(posted.read(), posted.scene());
    expect_stated_right(plain.log);
    const EnteredValues all[] = {{posted.moved({12, -8, 4}, {0.4, 0.2, -0.2}), {}},
                                 {std::nullopt, posted.lengths(1.5)},
                                 {std::nullopt, posted.lengths(-1.5)},
                                 {posted.moved({-10, 10, 10}, {-0.6, 0, 0.6}), posted.lengths(1.5)}};
    for (const EnteredValues& values : all) {
        ParsedProgram program = posted.read();
        ReplayScene scene = posted.scene();
        const Cell entered = cell_with(values, posted.job.cell);
        enter_in_program(values, posted.input(), program);
        enter_in_scene(values, posted.input(), entered, scene);
        const Walked walk = walked(program, scene);
        expect_stated_right(walk.log);
        for (const FindingKind kind : {FindingKind::reach, FindingKind::joint_limit, FindingKind::collision}) {
            EXPECT_EQ(walk.log.count(kind), plain.log.count(kind)) << to_word(kind);
        }
        EXPECT_LE(farthest(walk.path, plain.path), near_mm);
        const auto turns = [](const JointSweep& sweep) { return sweep.is_of_line; };
        EXPECT_EQ(std::ranges::count_if(walk.path.sweeps, turns) > 0, values.base.has_value());
    }
}

TEST_P(EnteredPosted, WhatOnlyTheProgramHasLeadsTheTipElsewhere) {
    const Walked plain = walked(posted.read(), posted.scene());
    ParsedProgram program = posted.read();
    enter_in_program({posted.moved({15, 0, 0}, {}), {}}, posted.input(), program);
    const Walked base = walked(program, posted.scene());
    EXPECT_GT(base.log.count(FindingKind::base_frame), 0U);
    EXPECT_NEAR(farthest(base.path, plain.path), 15, near_mm);
    program = posted.read();
    enter_in_program({std::nullopt, posted.lengths(1.5)}, posted.input(), program);
    const Walked longer = walked(program, posted.scene());
    EXPECT_GT(longer.log.count(FindingKind::tool_frame), 0U);
    EXPECT_NEAR(farthest(longer.path, plain.path), 1.5, near_mm);
}

TEST_P(EnteredPosted, LoadAndQuestionsStayAsPlanned) {
    posted.job.cell.machine->load_tolerance = {0.01, 0.01, 0.001};
    expect_stated_right(walked(posted.read(), posted.scene()).log);
    const EnteredValues values{std::nullopt, posted.lengths(1.9)};
    ParsedProgram program = posted.read();
    ReplayScene scene = posted.scene();
    const Cell entered = cell_with(values, posted.job.cell);
    enter_in_program(values, posted.input(), program);
    enter_in_scene(values, posted.input(), entered, scene);
    expect_stated_right(walked(program, scene).log);
    scene.planned_lengths.clear();
    const Walked as_entered = walked(program, scene);
    EXPECT_GT(as_entered.log.count(FindingKind::load), 0U);
    EXPECT_GT(as_entered.log.count(FindingKind::tool_change), 0U);
}

TEST_P(EnteredPosted, ALineBehindAJointMoveMayBeTurnedByTheEnteredTurnAndNoMore) {
    const EnteredValues values{posted.moved({}, {0.2, 0.5, -0.5}), {}};
    ParsedProgram program = posted.read();
    ReplayScene scene = posted.scene();
    enter_in_program(values, posted.input(), program);
    enter_in_scene(values, posted.input(), posted.job.cell, scene);
    EXPECT_NEAR(scene.entered_turn, 0.74 * degree, 0.03 * degree);
    EXPECT_EQ(walked(program, scene).log.count(FindingKind::tool_axis), 0U);
    for (const double less : {0.0, 0.4 * degree}) {
        scene.entered_turn = less;
        EXPECT_GT(walked(program, scene).log.count(FindingKind::tool_axis), 0U) << less;
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, EnteredPosted,
                         ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary", "irb6640-185-2.8"),
                         [](const auto& cell) {
                             const std::string name = cell.param;
                             return name.substr(0, name.find('-'));
                         });

}  // namespace
}  // namespace qchopper
