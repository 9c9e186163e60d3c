// Setups judge the cuts of a search: boxes that a short tool carves only where they are cut along.

#include "app/engine/review_cuts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "tests/app/engine/judge_cuts.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Two posts side by side. Across, each makes two towers of 425 mm, twice as high as the tool reaches; along, two
// boards.
TriangleMesh posts() {
    return shapes::joined(
        {shapes::box({-500, -150, -425}, {-200, 150, 425}, 6), shapes::box({200, -150, -425}, {500, 150, 425}, 6)});
}

Ranked plane(Vec3 normal, double offset, double total) {
    Ranked ranked;
    ranked.plane = {normal, offset};
    ranked.terms.total = total;
    return ranked;
}

struct Verdicts : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("verdict" + std::to_string(::getpid()));
    const TriangleMesh mesh = posts();

    void SetUp() override { make(100); }
    void TearDown() override { fs::remove_all(folder); }

    void make(double unreachable_weight) const {
        fs::remove_all(folder);
        fs::create_directories(folder);
        write_cell();
        Project project;
        project.scan = {"/posts.ply", Sha256{{0xaa}},        Unit::mm,         1,
                        {0, 0, 0},    mesh.triangles.size(), volume_mm3(mesh), {}};
        project.settings.objectives.weights.unreachable = unreachable_weight;
        project.settings.stop.min_cuts = 2;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        save_project(folder, project);
    }
    // A ready cell without its long tools, which would reach too much.
    void write_cell() const {
        const Bytes bytes = read_file(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
        std::string text(bytes.begin(), bytes.end());
        const std::size_t first = text.find("# The same with longer shanks");
        const std::size_t end = text.find("[[stock]]");
        ASSERT_LT(first, end);
        text.erase(first, end - first);
        write_file(folder / "cell.toml", text);
    }
    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    std::string bytes() const {
        const Bytes b = read_file(folder / "project.json");
        return {b.begin(), b.end()};
    }
    // Cuts the next post across; the other planes follow it in the ranking.
    static void cut_across(OpenProject& project, const std::vector<Ranked>& others) {
        Cut cut;
        cut.number = static_cast<std::int32_t>(project.project().cuts.size()) + 1;
        cut.piece = project.segmentation().pieces.front().name;
        cut.chosen = plane({0, 0, 1}, 0.4, 1);
        cut.candidates = 1 + others.size();
        cut.runners_up = others;
        ASSERT_TRUE(project.decide_cut(cut));
    }
    static void end_search(OpenProject& project) {
        const SearchEnd end = project.search(
            project.checks(), [](const Segmentation&) {}, {}, std::nullopt);
        EXPECT_TRUE(end.is_finished());
        EXPECT_EQ(project.project().stage, Stage::cut);
    }
    // The second of the others is the good one.
    static std::vector<Ranked> with_a_good_one(double x) {
        return {plane({0, 0, 1}, 20.4, 2), plane({1, 0, 0}, x, 3), plane({0, 0, 1}, -20.4, 4)};
    }
    void cut_both() const {
        OpenProject project = open();
        cut_across(project, with_a_good_one(-350.3));
        cut_across(project, with_a_good_one(350.3));
        end_search(project);
    }
    // As the file says, cut again, bit for bit.
    void expect_replayed(OpenProject& project) const {
        EXPECT_EQ(project.project(), load_project(folder));
        const Segmentation fresh = replay(load_project(folder), mesh);
        const Segmentation& now = project.segmentation();
        ASSERT_EQ(fresh.pieces.size(), now.pieces.size());
        for (std::size_t p = 0; p < fresh.pieces.size(); ++p) {
            EXPECT_EQ(fresh.pieces[p].name, now.pieces[p].name);
            EXPECT_EQ(*fresh.pieces[p].mesh, *now.pieces[p].mesh);
        }
    }
};

TEST_F(Verdicts, APlaneWhosePiecesCanBeMilledReplacesOneWhosePiecesCannot) {
    cut_both();
    OpenProject project = open();
    const std::vector<SolidRecord> before = project.project().pieces;
    judge_cuts(project);
    ASSERT_TRUE(project.project().review);
    const SetupReview review = *project.project().review;
    EXPECT_TRUE(review.is_done);
    ASSERT_EQ(review.cuts.size(), 2U);
    for (const CutReview& cut : review.cuts) {
        EXPECT_EQ(cut.outcome, ReviewOutcome::replaced);
        EXPECT_EQ(cut.planes, 3U);
        EXPECT_GT(cut.before.share(), 0.1);
        EXPECT_LT(cut.best.share(), 0.5 * cut.before.share());
    }
    for (const Cut& cut : project.project().cuts) {
        EXPECT_EQ(cut.chosen.plane.normal, (Vec3{1, 0, 0}));
        ASSERT_EQ(cut.runners_up.size(), 3U);
        EXPECT_EQ(cut.runners_up.front(), plane({0, 0, 1}, 0.4, 1)) << "the plane of before is the best by ranking";
    }
    EXPECT_EQ(project.project().stage, Stage::cut);
    EXPECT_EQ(project.project().end_reason, EndReason::rules_hold);
    EXPECT_EQ(project.project().pieces.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(project.project().pieces[i].name, before[i].name);
    for (const Piece& piece : project.segmentation().pieces) {
        EXPECT_EQ(read_file(folder / "pieces" / (piece.name + ".ply")).empty(), false);
    }
    expect_replayed(project);
    const std::string saved = bytes();
    judge_cuts(project);
    EXPECT_EQ(bytes(), saved) << "every cut is asked once";
}

TEST_F(Verdicts, UndoGivesThePlaneOfBeforeBackAndRedoReplacesItAgain) {
    cut_both();
    OpenProject project = open();
    const std::vector<Cut> before = project.project().cuts;
    const std::vector<SolidRecord> pieces = project.project().pieces;
    judge_cuts(project);
    const std::vector<Cut> after = project.project().cuts;
    ASSERT_TRUE(project.undo());
    EXPECT_EQ(project.project().cuts[1], before[1]);
    EXPECT_EQ(project.project().cuts[0], after[0]);
    EXPECT_FALSE(project.project().review);
    expect_replayed(project);
    OpenProject again = open();  // a reload in between
    ASSERT_TRUE(again.undo());
    EXPECT_EQ(again.project().cuts, before);
    EXPECT_EQ(again.project().pieces, pieces);
    expect_replayed(again);
    ASSERT_TRUE(again.redo());
    ASSERT_TRUE(again.redo());
    EXPECT_EQ(again.project().cuts, after);
    expect_replayed(again);
}

TEST_F(Verdicts, WhatIsInterruptedGoesOnToTheSameBytes) {
    cut_both();
    const fs::path copy = folder.string() + ".copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    {
        OpenProject project = open();
        judge_cuts(project);
    }
    const std::string whole = bytes();
    fs::remove_all(folder);
    fs::rename(copy, folder);
    {
        std::atomic<bool> stop = false;
        Context context;
        context.cancelled = &stop;
        context.on_progress = [&](const Progress& p) {
            if (p.what.find("cut 2 of piece") != std::string::npos) stop = true;
        };
        OpenProject project = open();
        EXPECT_THROW(judge_cuts(project, context), Cancelled);
    }
    const Project kept = load_project(folder);
    EXPECT_EQ(kept.stage, Stage::cutting);
    ASSERT_TRUE(kept.review);
    EXPECT_FALSE(kept.review->is_done);
    EXPECT_EQ(kept.review->cuts.size(), 1U) << "what was decided is kept";
    EXPECT_FALSE(fs::exists(folder / "pieces" / "C.ply")) << "no file of other cuts";
    {
        OpenProject project = open();
        EXPECT_TRUE(project.is_being_judged());
        judge_cuts(project);
    }
    EXPECT_EQ(bytes(), whole);
}

TEST_F(Verdicts, AGainBelowTheThresholdIsNone) {
    {
        OpenProject project = open();
        const std::vector<Ranked> others{plane({0, 0, 1}, 0.8, 2), plane({0, 0, 1}, -0.2, 3), plane({0, 0, 1}, 0.1, 4),
                                         plane({1, 0, 0}, -350.3, 5)};  // a fourth one is not tried
        cut_across(project, others);
        cut_across(project, {});
        end_search(project);
    }
    const Project before = load_project(folder);
    OpenProject project = open();
    judge_cuts(project);
    ASSERT_TRUE(project.project().review);
    ASSERT_EQ(project.project().review->cuts.size(), 2U);
    EXPECT_EQ(project.project().review->cuts[0].outcome, ReviewOutcome::kept);
    EXPECT_EQ(project.project().review->cuts[0].planes, 3U);
    const CutReview& first = project.project().review->cuts[0];
    EXPECT_LT(first.best.unreachable_mm2, first.before.unreachable_mm2) << "there is a gain";
    EXPECT_EQ(project.project().review->cuts[1].planes, 0U);
    Project after = project.project();
    after.review.reset();
    EXPECT_EQ(after, before) << "nothing but the verdict is new";
}

TEST_F(Verdicts, ACutThatCarriesOthersOrIsTheOperatorsStays) {
    {
        OpenProject project = open();
        cut_across(project, with_a_good_one(-350.3));
        Cut further;
        further.number = 2;
        further.piece = "C";
        further.chosen = plane({0, 1, 0}, 0.3, 1);
        further.chosen.normal_index = -1;  // given
        further.runners_up = {plane({0, 1, 0}, 10.3, 2)};
        ASSERT_TRUE(project.decide_cut(further));
        end_search(project);
    }
    OpenProject project = open();
    const std::vector<Cut> before = project.project().cuts;
    judge_cuts(project);
    ASSERT_TRUE(project.project().review);
    for (const CutReview& v : project.project().review->cuts) {
        EXPECT_EQ(v.outcome, v.cut == 1 ? ReviewOutcome::carries_cut : ReviewOutcome::decided);
    }
    EXPECT_FALSE(project.project().review->cuts.empty());
    EXPECT_EQ(project.project().cuts, before);
}

TEST_F(Verdicts, WithoutTheWeightNothingIsAsked) {
    make(0);
    cut_both();
    const std::string before = bytes();
    OpenProject project = open();
    judge_cuts(project);
    EXPECT_EQ(bytes(), before);
}

TEST_F(Verdicts, AreTheSameForAnyNumberOfThreads) {
    cut_both();
    const fs::path copy = folder.string() + ".copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    judge_cuts(open());
    const std::string many = bytes();
    fs::remove_all(folder);
    fs::rename(copy, folder);
    const ThreadLimit one(1);
    judge_cuts(open());
    EXPECT_EQ(bytes(), many);
}

}  // namespace
}  // namespace qchopper
