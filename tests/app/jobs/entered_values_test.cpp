// The values that a person enters at the controller: the programs of the ready cells are proven with them, and a
// program is not where scene and program have other ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "app/dispatch/restart_job.h"
#include "app/jobs/entered/entered_replay.h"
#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"
#include "cam/job/read_job.h"
#include "sim/replay/replay.h"
#include "sim/replay/walk/machine_walk.h"
#include "tests/app/jobs/proven_job.h"

namespace qchopper {
namespace {

constexpr const char* fixed_table = "kr60-ha";
constexpr const char* rotary_table = "kr120-r2500-pro-rotary";
constexpr const char* abb = "irb6640-185-2.8";

double rounded(double value, int decimals) {
    return std::stod(fixed(value, decimals));
}

// As the program states it.
EnteredBase planned(const ProvenJob& proven) {
    const Pose base = planned_base(proven.cell.cell, proven.job.setup, proven.job.setup_in_cell);
    const KukaAngles abc = kuka_angles(base);
    return {{rounded(base.shift.x, 3), rounded(base.shift.y, 3), rounded(base.shift.z, 3)},
            {rounded(degrees(abc.a), 4), rounded(degrees(abc.b), 4), rounded(degrees(abc.c), 4)}};
}

EnteredBase moved(const ProvenJob& proven, Vec3 shift, Vec3 abc_deg = {}) {
    EnteredBase base = planned(proven);
    base.shift = base.shift + shift;
    base.abc_deg = base.abc_deg + abc_deg;
    return base;
}

const CuttingTool& tool_of(const Cell& cell, std::uint16_t number) {
    return *std::ranges::find(cell.machine->tools, number, &CuttingTool::number);
}

// Of every tool of the job, longer by so much.
std::vector<EnteredLength> lengths(const ProvenJob& proven, double longer) {
    std::vector<EnteredLength> all;
    for (const JobChunk& chunk : proven.job.program->chunks) {
        if (std::ranges::count(all, chunk.tool, &EnteredLength::tool) > 0) continue;
        all.push_back({chunk.tool, rounded(gauge_length(tool_of(proven.cell.cell, chunk.tool)) + longer, 2)});
    }
    return all;
}

JobVerdict judged_with(const ReadJob& job, const CellFile& cell, const EnteredValues& values) {
    difference_from_plan(values, job, "A.qjob", cell.cell);
    return judge_job(job, "A.qjob", cell, "0.1.0", {}, {}, values);
}

std::string findings_of(const JobVerdict& verdict) {
    std::string text;
    for (const ProofFinding& finding : verdict.findings) text += finding.kind + " " + describe(finding) + "\n";
    return text;
}

// A program followed without foam, where cell, program and scene are put together by hand.
struct Walked {
    JobContents contents;
    ProofInput input;
    ParsedProgram program;
    Cell entered;
    ReplayScene scene;

    Walked(const ProvenJob& proven, const Cell& cell)
        : contents(proven.job, "A.qjob"),
          input(contents.input(cell)),
          program(program_read_back(input)),
          scene(scene_of(input)) {}
    Walked(const Walked&) = delete;
    Walked& operator=(const Walked&) = delete;

    void enter(const EnteredValues& values) {
        entered = cell_with(values, input.cell);
        enter_in_program(values, input, program);
        enter_in_scene(values, input, entered, scene);
    }
    FindingLog findings() const {
        FindingLog log;
        walk_machine(program, scene, log, {});
        return log;
    }
    std::size_t count(FindingKind kind) const { return findings().count(kind); }
};

struct EnteredValuesIn : ::testing::TestWithParam<const char*> {
    const ProvenJob& proven = proven_job(GetParam());
};

TEST_P(EnteredValuesIn, ThePlannedOnesGiveTheSameVerdict) {
    const JobVerdict again = judged_with(proven.job, proven.cell, {planned(proven), lengths(proven, 0)});
    EXPECT_TRUE(proven.verdict.is_positive);
    EXPECT_EQ(again, proven.verdict) << findings_of(again);
    const EnteredDifference none =
        difference_from_plan({planned(proven), lengths(proven, 0)}, proven.job, "A.qjob", proven.cell.cell);
    EXPECT_LT(none.base->shift, 1e-3);
    EXPECT_LT(none.base->turn_deg, 1e-3);
}

TEST_P(EnteredValuesIn, ABaseWithinTheLimitsIsProven) {
    const EnteredBase base = moved(proven, {12, -8, 4}, {0.4, 0.2, -0.2});
    const EnteredDifference off = difference_from_plan({base, {}}, proven.job, "A.qjob", proven.cell.cell);
    EXPECT_NEAR(off.base->shift, 14.97, 0.01);
    EXPECT_NEAR(off.base->turn_deg, 0.49, 0.01);
    const JobVerdict verdict = judged_with(proven.job, proven.cell, {base, {}});
    EXPECT_TRUE(verdict.is_positive) << findings_of(verdict);
    EXPECT_GE(verdict.figure("within_tolerance_percent"), 99.5);
    EXPECT_NE(verdict.figures, proven.verdict.figures) << "it was replayed elsewhere";
    EXPECT_NEAR(verdict.figure("max_gouge_mm"), proven.verdict.figure("max_gouge_mm"), 0.02)
        << "the tip goes the same way in the piece";
    std::printf("%s: gouge %.3f mm, planned %.3f; within %.3f %%, planned %.3f\n", GetParam(),
                verdict.figure("max_gouge_mm"), proven.verdict.figure("max_gouge_mm"),
                verdict.figure("within_tolerance_percent"), proven.verdict.figure("within_tolerance_percent"));
}

TEST_P(EnteredValuesIn, LongerAndShorterToolsAreProven) {
    for (const double longer : {1.5, -1.5}) {
        const JobVerdict verdict = judged_with(proven.job, proven.cell, {std::nullopt, lengths(proven, longer)});
        EXPECT_TRUE(verdict.is_positive) << longer << ":\n" << findings_of(verdict);
        EXPECT_GE(verdict.figure("within_tolerance_percent"), 99.5);
        EXPECT_NEAR(verdict.figure("max_gouge_mm"), proven.verdict.figure("max_gouge_mm"), 0.02);
    }
}

TEST_P(EnteredValuesIn, BaseAndToolsTogetherAreProven) {
    std::vector<EnteredLength> longer = lengths(proven, 1.5);
    longer.resize(1);  // one tool alone; another one may be as long by the plan
    const JobVerdict verdict =
        judged_with(proven.job, proven.cell, {moved(proven, {-10, 5, 8}, {-0.5, 0, 0.3}), longer});
    EXPECT_TRUE(verdict.is_positive) << findings_of(verdict);
}

TEST_P(EnteredValuesIn, AValueThatOnlyTheProgramHasIsFound) {
    {
        Walked walked(proven, proven.cell.cell);
        enter_in_program({moved(proven, {15, 0, 0}), {}}, walked.input, walked.program);
        const ReplayReport report = replay(walked.program, walked.scene, {});
        EXPECT_GT(report.counts[static_cast<std::size_t>(FindingKind::base_frame)], 0U);
        EXPECT_GT(report.largest_gouge, 1) << "the block does not stand where the program carves";
    }
    Walked walked(proven, proven.cell.cell);
    enter_in_program({std::nullopt, lengths(proven, -1.5)}, walked.input, walked.program);
    const ReplayReport report = replay(walked.program, walked.scene, {});
    EXPECT_GT(report.counts[static_cast<std::size_t>(FindingKind::tool_frame)], 0U);
    EXPECT_NEAR(report.largest_gouge, 1.5, 0.4) << "the tools are longer than the program takes them for";
}

TEST_P(EnteredValuesIn, ALineBehindAJointMoveMayBeTurnedByTheEnteredTurnAndNoMore) {
    const EnteredValues values{moved(proven, {}, {0.2, 0.5, -0.5}), {}};
    Walked walked(proven, proven.cell.cell);
    walked.enter(values);
    EXPECT_EQ(walked.count(FindingKind::tool_axis), 0U);
    walked.scene.entered_turn = 0;
    const std::size_t joint_moves = walked.count(FindingKind::tool_axis);
    EXPECT_GT(joint_moves, 0U);
    walked.scene.entered_turn = 0.5 * degree;
    EXPECT_GT(walked.count(FindingKind::tool_axis), 0U) << "0.7 degrees are more";
    EXPECT_LE(walked.count(FindingKind::tool_axis), joint_moves);
}

TEST_P(EnteredValuesIn, WhatIsTooFarFromThePlanIsRefused) {
    const auto refusal = [&](const EnteredValues& values) -> std::string {
        try {
            difference_from_plan(values, proven.job, "A.qjob", proven.cell.cell);
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use);
            EXPECT_FALSE(error.to_do.empty());
            return error.what();
        }
        return "taken";
    };
    const auto base = [&](Vec3 shift, Vec3 abc_deg) { return refusal({moved(proven, shift, abc_deg), {}}); };
    const std::uint16_t tool = lengths(proven, 0).front().tool;
    const double planned_length = lengths(proven, 0).front().length;
    const auto length = [&](double longer) { return refusal({std::nullopt, {{tool, planned_length + longer}}}); };
    EXPECT_EQ(base({0, 19.9, 0}, {0.9, 0, 0}), "taken");
    EXPECT_EQ(length(1.99), "taken");
    EXPECT_EQ(length(-1.99), "taken");
    EXPECT_TRUE(base({1000, 0, 0}, {}).starts_with("the entered base is 1000.0 mm and 0.00 degrees from the base"));
    EXPECT_TRUE(base({0, 0, 20.1}, {}).ends_with("at most 20 mm and 1 degree are allowed"));
    EXPECT_TRUE(base({}, {2, 0, 0}).starts_with("the entered base is 0.0 mm and 2.00 degrees from"));
    EXPECT_TRUE(base({}, {90, 0, 0}).starts_with("the entered base is 0.0 mm and 90.00 degrees from"));
    EXPECT_NE(base({std::numeric_limits<double>::infinity(), 0, 0}, {}).find("six finite numbers"), std::string::npos);
    EXPECT_NE(length(30).find(" mm, 30.00 mm from the "), std::string::npos) << length(30);
    EXPECT_NE(length(-2.1).find("at most 2 mm are allowed"), std::string::npos) << length(-2.1);
    EXPECT_NE(length(std::numeric_limits<double>::quiet_NaN()).find("no finite number"), std::string::npos);
    EXPECT_TRUE(refusal({std::nullopt, {{999, 200}}}).starts_with("A.qjob does not use tool 999, but tool"));
    EXPECT_NE(refusal({std::nullopt, {{tool, planned_length}, {tool, planned_length}}}).find("is given twice"),
              std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Cells, EnteredValuesIn, ::testing::Values(fixed_table, rotary_table, abb),
                         [](const auto& cell) {
                             std::string name = cell.param;
                             std::replace_if(
                                 name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
                             return name;
                         });

std::string refusal_of(const ReadJob& job, const Cell& cell) {
    try {
        difference_from_plan({EnteredBase{}, {}}, job, "A.qjob", cell);
    } catch (const InputError& error) {
        return error.what();
    }
    return "taken";
}

TEST(EnteredValues, AJobThatStatesNoBaseIsRefused) {
    const ProvenJob& proven = proven_job(fixed_table);
    ReadJob job = proven.job;
    job.program.reset();
    job.no_program_because = "prepare was asked for none";
    EXPECT_NE(refusal_of(job, proven.cell.cell).find("holds no robot program"), std::string::npos);
    job = proven.job;
    ++job.cell_id;
    EXPECT_NE(refusal_of(job, proven.cell.cell).find("is made for cell"), std::string::npos);
    Cell gantry = proven.cell.cell;
    gantry.machine->robot.reset();
    EXPECT_NE(refusal_of(proven.job, gantry).find("a machine without an arm"), std::string::npos);
}

// The largest or smallest value up to which the planned program is free of findings of a kind.
double last_free(const ProvenJob& proven, FindingKind kind, double free, double found,
                 const std::function<void(Cell&, double)>& set) {
    const auto is_free = [&](double value) {
        Cell cell = proven.cell.cell;
        set(cell, value);
        return Walked(proven, cell).count(kind) == 0;
    };
    EXPECT_TRUE(is_free(free));
    EXPECT_FALSE(is_free(found));
    for (int i = 0; i < 12; ++i) {
        const double middle = 0.5 * (free + found);
        (is_free(middle) ? free : found) = middle;
    }
    return free;
}

// The verdict in the cell where the planned program is only just free.
void expect_found(const ProvenJob& proven, const char* kind, const std::function<void(Cell&)>& change,
                  const EnteredValues& values) {
    CellFile cell = proven.cell;
    change(cell.cell);
    const JobVerdict plain = judged(proven.job, cell);
    EXPECT_TRUE(plain.is_positive) << findings_of(plain);
    const JobVerdict verdict = judged_with(proven.job, cell, values);
    EXPECT_FALSE(verdict.is_positive);
    const auto is_kind = [&](const ProofFinding& finding) { return finding.kind == kind; };
    EXPECT_TRUE(std::any_of(verdict.findings.begin(), verdict.findings.end(), is_kind)) << findings_of(verdict);
}

TEST(EnteredValues, AnObstacleInTheWayIsFound) {
    const ProvenJob& proven = proven_job(fixed_table);
    const double middle = proven.job.setup_in_cell.front().shift.x;
    const auto set = [](Cell& cell, double x) {  // a wall behind the block, lower than the tool at home
        cell.machine->obstacles.push_back({"wall", {{x, -3000, 400}, {x + 500, 3000, 800}}});
    };
    const double wall = last_free(proven, FindingKind::collision, middle + 1500, middle, set);
    expect_found(proven, "collision", [&](Cell& cell) { set(cell, wall); }, {moved(proven, {15, 0, 0}), {}});
}

TEST(EnteredValues, AJointBeyondItsRangeIsFound) {
    const ProvenJob& proven = proven_job(fixed_table);
    const auto set = [](Cell& cell, double most) { cell.machine->robot->ranges[1].max = most; };
    const double most = last_free(proven, FindingKind::joint_limit, proven.cell.cell.machine->robot->ranges[1].max,
                                  proven.cell.cell.machine->robot->ranges[1].min, set);
    expect_found(proven, "joint_limit", [&](Cell& cell) { set(cell, most); }, {moved(proven, {19, 0, 0}), {}});
}

TEST(EnteredValues, LoadDataStaysAsPlanned) {
    const ProvenJob& proven = proven_job(fixed_table);
    Cell cell = proven.cell.cell;
    cell.machine->load_tolerance = {0.01, 0.01, 0.001};
    EXPECT_EQ(Walked(proven, cell).count(FindingKind::load), 0U);
    Walked walked(proven, cell);
    walked.enter({std::nullopt, lengths(proven, 1.5)});
    EXPECT_EQ(walked.count(FindingKind::load), 0U);
    walked.scene.planned_lengths.clear();
    EXPECT_GT(walked.count(FindingKind::load), 0U) << "of the entered lengths it would be another one";
    EXPECT_GT(walked.count(FindingKind::tool_change), 0U) << "and so would be the question";
}

TEST(EnteredValues, ARestartIsProvenWithThem) {
    const ProvenJob& proven = proven_job(fixed_table);
    const RestartJob made =
        make_restart({proven.job, "A.qjob", proven.cell.cell, proven.job.program->chunks.size() - 1, 0});
    const ReadJob job = parse_job(made.file, made.name);
    const JobVerdict plain = judged(job, proven.cell);
    EXPECT_TRUE(plain.is_positive) << findings_of(plain);
    const JobVerdict same = judged_with(job, proven.cell, {planned(proven), {}});
    EXPECT_EQ(same, plain);
    const JobVerdict verdict = judged_with(job, proven.cell, {moved(proven, {5, 5, 5}, {0.3, 0, 0}), {}});
    EXPECT_TRUE(verdict.is_positive) << findings_of(verdict);
}

}  // namespace
}  // namespace qchopper
