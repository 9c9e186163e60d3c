#include "sim/replay/stages/replay_stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/parallel.h"
#include "sim/replay/replay.h"
#include "sim/replay/stages/stock_surface.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

struct Taken {
    StagedReplay replay;
    std::vector<StockRecord> stock;
    std::vector<TriangleMesh> surfaces;
};

Taken taken(const BoxJob& job, const ReplayScene& scene, const StageOptions& options = {}) {
    Taken result;
    const auto take = [&](const ReplayStage&, const StockModel& stock_model) {
        result.stock.push_back(stock_model.record());
        result.surfaces.push_back(stock_surface(stock_model, 3));
    };
    result.replay = replay_in_stages(read_back(job, job.files()), scene, options, take);
    return result;
}

ReplayReport replayed(const BoxJob& job, ReplayScene scene, double cell) {
    scene.is_last = false;  // so that the report has the stock that is left
    ReplayOptions options;
    options.cell = cell;
    return replay(read_back(job, job.files()), scene, options);
}

class ReplayStages : public testing::TestWithParam<std::string> {};

TEST_P(ReplayStages, TheLastStageIsTheStockOfTheReplayCellByCell) {
    const BoxJob job = box_job(GetParam());
    for (const double cell : {0.5, 1.0}) {
        StageOptions options;
        options.cell = cell;
        const Taken made = taken(job, job.scene(), options);
        const ReplayReport report = replayed(job, job.scene(), cell);
        ASSERT_FALSE(made.stock.empty());
        EXPECT_EQ(made.stock.back().maps, report.left.maps) << cell;
        EXPECT_NE(made.stock.front().maps, report.left.maps) << "the first one is the whole block";
    }
}

TEST_P(ReplayStages, TimesIncreaseToTheReportedTimeAndVolumesAddUp) {
    const BoxJob job = box_job(GetParam());
    const StagedReplay made = taken(job, job.scene()).replay;
    const ReplayReport report = replayed(job, job.scene(), StageOptions{}.cell);
    EXPECT_EQ(made.seconds, report.time.seconds);
    EXPECT_EQ(made.removed_mm3, report.milling.removed_mm3);
    ASSERT_GT(made.stages.size(), 3U);
    EXPECT_LE(made.stages.size(), 25U);
    EXPECT_EQ(made.stages.front().seconds, 0);
    EXPECT_EQ(made.stages.front().removed_mm3, 0);
    EXPECT_EQ(made.stages.back().seconds, report.time.seconds);
    EXPECT_NEAR(made.stages.back().removed_mm3, report.milling.removed_mm3, 1e-6 * report.milling.removed_mm3);
    EXPECT_EQ(made.stages.back().points, made.way.size());
    for (std::size_t i = 1; i < made.stages.size(); ++i) {
        EXPECT_GT(made.stages[i].seconds, made.stages[i - 1].seconds) << i;
        EXPECT_GE(made.stages[i].removed_mm3, made.stages[i - 1].removed_mm3) << i;
        EXPECT_GT(made.stages[i].points, made.stages[i - 1].points) << i;
    }
}

// Each stage but the last is the first moment with its share.
TEST_P(ReplayStages, StagesStandAtEqualVolumes) {
    const BoxJob job = box_job(GetParam());
    StageOptions options;
    options.stages = 4;
    const StagedReplay made = taken(job, job.scene(), options).replay;
    const std::vector<LineCut> lines = replayed(job, job.scene(), options.cell).milling.lines;
    const double largest = std::max_element(lines.begin(), lines.end(), [](const LineCut& a, const LineCut& b) {
                               return a.removed_mm3 < b.removed_mm3;
                           })->removed_mm3;
    ASSERT_EQ(made.stages.size(), 5U);
    for (std::size_t i = 0; i + 1 < made.stages.size(); ++i) {
        const double share = made.removed_mm3 * static_cast<double>(i) / 4;
        EXPECT_GE(made.stages[i].removed_mm3, share) << i;
        EXPECT_LT(made.stages[i].removed_mm3, share + largest) << i;
    }
}

TEST_P(ReplayStages, TheWayHasTheTimesAndPlacesOfTheProgram) {
    const BoxJob job = box_job(GetParam());
    const ParsedProgram program = read_back(job, job.files());
    const StagedReplay made = taken(job, job.scene()).replay;
    ASSERT_FALSE(made.way.empty());
    EXPECT_EQ(made.way.back().seconds, made.seconds);
    double before = 0;
    std::array<std::size_t, 5> kinds{};
    for (const WayPoint& point : made.way) {
        EXPECT_GE(point.seconds, before);
        before = point.seconds;
        ++kinds[static_cast<std::size_t>(point.kind)];
        ASSERT_LT(point.place.file, program.files.size());
        EXPECT_GT(point.place.line, 0U);
    }
    for (const WayKind kind : {WayKind::joint_move, WayKind::link, WayKind::cut}) {
        EXPECT_GT(kinds[static_cast<std::size_t>(kind)], 0U) << static_cast<int>(kind);
    }
    const std::size_t cuts = replayed(job, job.scene(), StageOptions{}.cell).milling.cuts;
    EXPECT_EQ(kinds[static_cast<std::size_t>(WayKind::cut)], cuts);
}

TEST_P(ReplayStages, OneThreadAndTwoGiveTheSame) {
    const BoxJob job = box_job(GetParam());
    std::vector<Taken> made;
    for (const std::size_t threads : {1U, 2U}) {
        const ThreadLimit limit(threads);
        made.push_back(taken(job, job.scene()));
    }
    EXPECT_EQ(made[0].stock, made[1].stock);
    ASSERT_EQ(made[0].surfaces.size(), made[1].surfaces.size());
    for (std::size_t i = 0; i < made[0].surfaces.size(); ++i) {
        EXPECT_EQ(made[0].surfaces[i].points, made[1].surfaces[i].points);
        EXPECT_EQ(made[0].surfaces[i].triangles, made[1].surfaces[i].triangles);
    }
}

// The stock of the part before has the cells of the proof, which are smaller.
TEST_P(ReplayStages, ASecondPartGoesOnFromWhatTheFirstOneLeft) {
    const BoxJob job = box_job(GetParam());
    ReplayScene scene = job.scene();
    const ReplayReport first = replayed(job, scene, 0.25);
    scene.before = &first.left;
    const Taken made = taken(job, scene);
    const Taken whole = taken(job, job.scene());
    EXPECT_LT(made.replay.removed_mm3, 0.05 * whole.replay.removed_mm3) << "nearly all of it is removed already";
    EXPECT_NE(made.stock.front(), whole.stock.front());
}

TEST_P(ReplayStages, WhatIsNoSceneIsRefused) {
    const BoxJob job = box_job(GetParam());
    ReplayScene scene = job.scene();
    scene.chunks.clear();
    EXPECT_THROW(taken(job, scene), InputError);
}

INSTANTIATE_TEST_SUITE_P(Cells, ReplayStages, testing::Values("kr60-ha", "kr120-r2500-pro-rotary"),
                         [](const auto& tested) { return tested.param == "kr60-ha" ? "Fixed" : "Rotary"; });

}  // namespace
}  // namespace qchopper
