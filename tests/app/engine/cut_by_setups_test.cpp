// Pieces of which the setup of the job leaves too much out of reach are cut again: towers that a short tool carves only
// in part, of which a tool without holder reaches everything.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "app/engine/planes_by_setups.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "tests/app/engine/judge_cuts.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double limit = 0.02;

// Two posts, which the operator cuts across: towers of 425 mm, where the longest tool has 150.
struct CutBySetups : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("cut_by_setups" + std::to_string(::getpid()));
    const TriangleMesh mesh = shapes::joined(
        {shapes::box({-500, -150, -425}, {-200, 150, 425}, 6), shapes::box({200, -150, -425}, {500, 150, 425}, 6)});

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        fs::copy_file(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml", folder / "cell.toml");
        Project project;
        project.scan = {"/posts.ply", Sha256{{0xaa}},        Unit::mm,         1,
                        {0, 0, 0},    mesh.triangles.size(), volume_mm3(mesh), {}};
        project.settings.stop.max_unreachable = limit;
        project.settings.stop.min_cuts = 2;
        project.settings.candidates.offsets_per_normal = 9;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        save_project(folder, project);
        OpenProject towers = open();
        for (int post = 0; post < 2; ++post) {
            Cut cut;
            cut.number = post + 1;
            cut.piece = towers.segmentation().pieces.front().name;
            cut.chosen.plane = {{0, 0, 1}, 0.4};
            ASSERT_TRUE(towers.decide_cut(cut));
        }
        const SearchEnd end = towers.search(
            towers.checks(), [](const Segmentation&) {}, {}, std::nullopt);
        ASSERT_TRUE(end.is_finished()) << "a tool without holder reaches everything: " << end.sentence;
    }
    void TearDown() override { fs::remove_all(folder); }

    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    std::string bytes() const {
        const Bytes b = read_file(folder / "project.json");
        return {b.begin(), b.end()};
    }
    std::vector<std::string> above_limit(OpenProject& project) const {
        std::vector<std::string> names;
        for (const Piece& piece : project.segmentation().pieces) {
            if (project.setups()->left_by_setup(piece).share > limit) names.push_back(piece.name);
        }
        return names;
    }
};

TEST_F(CutBySetups, NoPieceIsLeftAboveTheLimitWithoutBeingNamed) {
    OpenProject project = open();
    ASSERT_EQ(above_limit(project).size(), 4U);
    std::size_t rounds = 0;
    judge_cuts(project, {}, [&](const Segmentation&) { ++rounds; });
    EXPECT_GE(rounds, 4U);
    EXPECT_GT(project.project().cuts.size(), 5U);
    const std::vector<std::string> above = above_limit(project);
    EXPECT_TRUE(above.empty()) << above.front();
    EXPECT_EQ(project.project().do_rules_hold(), above.empty());
    EXPECT_EQ(project.project().stage, Stage::cut);
    EXPECT_FALSE(project.project().beam);
    EXPECT_EQ(project.project(), load_project(folder));
    double volume = 0;
    for (const Piece& piece : project.segmentation().pieces) volume += volume_mm3(*piece.mesh);
    EXPECT_NEAR(volume / volume_mm3(mesh), 1, 1e-9);
    const std::string saved = bytes();
    judge_cuts(project);
    EXPECT_EQ(bytes(), saved) << "once";
}

TEST_F(CutBySetups, APieceThatMayNotBeCutFurtherIsNamedAndTheRulesDoNotHold) {
    OpenProject project = open();
    StopRules rules = project.project().settings.stop;
    rules.max_cuts = 3;
    project.set_search(rules, 1);
    project.search(
        project.checks(), [](const Segmentation&) {}, {}, std::nullopt);
    judge_cuts(project);
    const std::vector<std::string> above = above_limit(project);
    EXPECT_GE(above.size(), 3U);
    EXPECT_FALSE(project.project().do_rules_hold());
    EXPECT_EQ(project.project().end_reason, EndReason::max_cuts);
    ASSERT_FALSE(project.project().warnings.empty());
    EXPECT_EQ(project.project().warnings.back(), early_end(project.project().ended_because));
}

TEST_F(CutBySetups, WhatIsInterruptedGoesOnToTheSameBytes) {
    const fs::path copy = folder.string() + ".copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    judge_cuts(open());
    const std::string whole = bytes();
    fs::remove_all(folder);
    fs::rename(copy, folder);
    {
        std::atomic<bool> stop = false;
        Context context;
        context.cancelled = &stop;
        OpenProject project = open();
        const auto at_the_second = [&](const Segmentation& s) { stop = s.cuts.size() > 3; };
        EXPECT_THROW(judge_cuts(project, context, at_the_second), Cancelled);
    }
    const Project kept = load_project(folder);
    EXPECT_EQ(kept.stage, Stage::cutting);
    EXPECT_GT(kept.cuts.size(), 3U) << "what was decided is kept";
    ASSERT_TRUE(kept.review);
    EXPECT_TRUE(kept.review->are_cuts_asked);
    {
        const ThreadLimit one(1);
        OpenProject project = open();
        EXPECT_TRUE(project.is_being_judged());
        judge_cuts(project);
    }
    EXPECT_EQ(bytes(), whole);
}

// What the arm refuses is cut after setups have judged all: a program that goes on there must not judge again, because
// one that was never ended does not either.
TEST_F(CutBySetups, ASearchForRefusedPiecesIsNoReasonToJudgeAgain) {
    OpenProject project = open();
    judge_cuts(project);
    ASSERT_TRUE(project.project().review && project.project().review->is_done);
    const auto one_more_cut = [&] {
        StopRules stop = project.project().settings.stop;
        stop.min_cuts = project.project().cuts.size() + 1;
        project.set_search(stop, 1);
    };
    std::size_t cuts = project.project().cuts.size();
    one_more_cut();
    const auto is_kept = [&](const Segmentation&) { EXPECT_TRUE(load_project(folder).review) << "after a kill too"; };
    project.cut_refused(is_kept, {}, std::nullopt);
    EXPECT_GT(project.project().cuts.size(), cuts);
    EXPECT_FALSE(open().begin_review());
    cuts = project.project().cuts.size();
    one_more_cut();
    project.search(project.checks(), {}, {}, std::nullopt);
    EXPECT_GT(project.project().cuts.size(), cuts);
    EXPECT_TRUE(open().begin_review()) << "other cuts are judged";
}

// A limit that has passed before this cutting begins allows no round; one that passes in it lets the round be finished.
TEST_F(CutBySetups, WhatRunsOutOfTimeGoesOnToTheSameBytes) {
    const fs::path copy = folder.string() + ".copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    const std::optional<SearchEnd> whole_end = judge_cuts(open());
    ASSERT_TRUE(whole_end);
    EXPECT_FALSE(whole_end->is_out_of_time());
    const std::string whole = bytes();
    fs::remove_all(folder);
    fs::rename(copy, folder);
    const auto judge_for = [&](std::chrono::milliseconds wait) {
        return judge_cuts(open(), {}, {}, TimeLimit{1e-9, std::chrono::steady_clock::now() + wait}).value();
    };
    const std::size_t before = load_project(folder).cuts.size();
    EXPECT_TRUE(judge_for(std::chrono::milliseconds(-1)).is_out_of_time());
    EXPECT_EQ(load_project(folder).cuts.size(), before);
    int runs = 1;
    for (; runs < 60 && judge_for(std::chrono::milliseconds(200)).is_out_of_time(); ++runs) {
        EXPECT_FALSE(load_project(folder).review->is_done);
    }
    EXPECT_GT(runs, 1);
    EXPECT_LT(runs, 60);
    EXPECT_EQ(bytes(), whole);
}

// Each plane made, and its pieces set up, one by one.
TEST_F(CutBySetups, ThePlaneThatComesFirstLeavesLeast) {
    OpenProject project = open();
    SearchSettings settings = project.project().settings;
    const Segmentation& now = project.segmentation();
    EvaluationCache& cache = project.cache();
    const std::vector<Ranked> ranked = rank(now, 0, settings, cache, {});
    const std::vector<Ranked> ordered = planes_by_setups(now, 0, ranked, settings, *project.setups(), cache, {});
    ASSERT_GE(ordered.size(), ranked.size());
    const auto above_limit_mm2 = [&](const Ranked& plane) {
        Segmentation after = now;
        EXPECT_TRUE(apply(after, cut_by(now, 0, {plane}, 0, settings), 0));
        double sum = 0;
        for (const Piece& piece : after.pieces) {
            if (made_by(piece) != static_cast<std::int32_t>(after.cuts.size())) continue;
            const SurfaceAccess access = project.setups()->mapped(piece).setup().access;
            if (access.unreachable_share() > limit) sum += access.unreachable_mm2();
        }
        return sum;
    };
    const double first = above_limit_mm2(ordered.front());
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Ranked middle =
            *project.own_plane(0, {axis, height(axis, bounds(*now.pieces[0].mesh).centre()) + 0.2}, {});
        EXPECT_LE(first, above_limit_mm2(middle) + 1) << "through the middle";
    }
    EXPECT_LE(first, above_limit_mm2(ranked.front()) + 1e-6);
}

}  // namespace
}  // namespace qchopper
