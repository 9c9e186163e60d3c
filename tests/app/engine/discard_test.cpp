// Pieces that the operator leaves out: decisions like cuts, never lost from the books.

#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "app/engine/open_project.h"
#include "app/engine/replay_plan.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Discarding : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("discard" + std::to_string(::getpid()));
    const TriangleMesh mesh = shapes::linked_tori();

    void SetUp() override {
        fs::create_directories(folder);
        save_project(folder, fresh());
    }
    void TearDown() override { fs::remove_all(folder); }

    Project fresh() const {
        Project project;
        project.scan = {"/a bone.ply", Sha256{{0xdd}}, Unit::mm, 1, {7, 8, 9}, 0, volume_mm3(mesh), {}};
        project.scan.faces = mesh.triangles.size();
        project.settings.candidates.offsets_per_normal = 5;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        return project;
    }
    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    static void accept(OpenProject& project, std::size_t k) {
        const std::size_t piece = *project.next({}).piece;
        const std::vector<Ranked> ranked = project.ranking(piece, 1, {});
        ASSERT_TRUE(project.decide_cut(cut_by(project.segmentation(), piece, ranked, k, project.project().settings)));
    }
    static double volume_of(const Segmentation& s) {
        double volume = 0;
        for (const Piece& p : s.pieces) volume += volume_mm3(*p.mesh);
        for (const Fragment& c : s.fragments) volume += c.volume_mm3;
        for (const Discarded& d : s.discarded) volume += volume_mm3(*d.piece.mesh);
        return volume;
    }
    // All that stands, without the history.
    std::string committed() const {
        Project project = load_project(folder);
        project.history = {};
        return to_json(project);
    }
    std::set<std::string> piece_files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder / "pieces")) names.insert(entry.path().filename());
        return names;
    }
};

TEST_F(Discarding, IsADecisionThatIsUndoneRedoneAndResetLikeACut) {
    std::vector<std::string> stood{committed()};
    std::string first;
    {
        OpenProject project = open();
        accept(project, 0);
        stood.push_back(committed());
        first = project.segmentation().pieces.front().name;
        const std::string last = project.segmentation().pieces.back().name;
        EXPECT_TRUE(project.decide_discard({last}));
        stood.push_back(committed());
        EXPECT_FALSE(piece_named(project.segmentation(), last));
        EXPECT_EQ(load_project(folder).discards, (std::vector<Discard>{{last, 1}}));
        accept(project, 1);
        stood.push_back(committed());
        EXPECT_TRUE(project.decide_discard({project.segmentation().pieces.front().name}));
        stood.push_back(committed());
        EXPECT_EQ(project.project().discarded.size(), 2U);
        EXPECT_NEAR(volume_of(project.segmentation()), volume_mm3(mesh), 1e-9 * volume_mm3(mesh));
        EXPECT_TRUE(project.decide_reset());
        stood.push_back(committed());
        EXPECT_TRUE(project.project().discards.empty());
    }
    OpenProject project = open();
    EXPECT_EQ(describe(*to_undo(project.project().history)), "reset");
    for (std::size_t i = stood.size() - 1; i-- > 0;) {
        ASSERT_TRUE(project.undo());
        EXPECT_EQ(committed(), stood[i]) << i;
    }
    OpenProject again = open();
    for (std::size_t i = 1; i < stood.size(); ++i) {
        ASSERT_TRUE(again.redo());
        EXPECT_EQ(committed(), stood[i]) << i;
        EXPECT_EQ(again.project(), load_project(folder)) << i;
        Project derived = load_project(folder);
        record(derived, replay(derived, mesh));
        EXPECT_EQ(derived, load_project(folder)) << i;
    }
}

TEST_F(Discarding, OfTheOnlyPieceOrOfNoneChangesNothing) {
    OpenProject project = open();
    while (project.segmentation().pieces.size() > 1) {
        ASSERT_TRUE(project.decide_discard({project.segmentation().pieces.back().name}));
    }
    const std::string before = committed();
    EXPECT_FALSE(project.decide_discard({project.segmentation().pieces.front().name}));
    EXPECT_FALSE(project.decide_discard({"no such piece"}));
    EXPECT_EQ(committed(), before);
}

TEST_F(Discarding, IsSaidWithItsVolumeAndSurvivesTheSearch) {
    OpenProject project = open();
    accept(project, 0);
    const std::string name = project.segmentation().pieces.back().name;
    ASSERT_TRUE(project.decide_discard({name}));
    StopRules rules;
    rules.min_cuts = 3;
    for (const std::size_t beam : {1U, 3U}) {
        project.set_search(rules, beam);
        EXPECT_TRUE(project
                        .search(
                            {}, [](const Segmentation&) {}, {}, std::nullopt)
                        .is_finished());
        const Project saved = load_project(folder);
        ASSERT_EQ(saved.discarded.size(), 1U);
        EXPECT_EQ(saved.discarded[0].name, name);
        ASSERT_FALSE(saved.warnings.empty());
        EXPECT_NE(saved.warnings[0].find("piece " + name + " ("), std::string::npos) << saved.warnings[0];
        for (const Cut& cut : std::span(saved.cuts).subspan(1)) EXPECT_NE(cut.piece, name);
        EXPECT_FALSE(fs::exists(folder / "pieces" / (name + ".ply")));
        EXPECT_NEAR(volume_of(project.segmentation()), volume_mm3(mesh), 1e-9 * volume_mm3(mesh));
        rules.min_cuts = 4;
    }
}

TEST_F(Discarding, OfAProjectFileThatNamesNoPieceIsRefused) {
    {
        OpenProject project = open();
        accept(project, 0);
        ASSERT_TRUE(project.decide_discard({project.segmentation().pieces.back().name}));
    }
    Project broken = load_project(folder);
    broken.discards.front().piece = "QQ";
    EXPECT_THROW(replay(broken, mesh), InputError);
}

TEST_F(Discarding, StandsInThePlanAndIsMadeAgain) {
    OpenProject project = open();
    ASSERT_TRUE(project.decide_discard({project.segmentation().pieces.back().name}));  // before any cut
    accept(project, 3);
    ASSERT_TRUE(project.decide_discard({project.segmentation().pieces.back().name}));
    accept(project, 0);
    const Plan plan = make_plan(project.project(), mesh);
    ASSERT_EQ(plan.discards.size(), 2U);
    EXPECT_EQ(plan.discards[0].after, 0);
    EXPECT_EQ(plan.discards[1].after, 1);
    EXPECT_EQ(plan_from_text(to_text(plan), "p"), plan);

    const fs::path again = folder / "again";
    fs::create_directories(again);
    save_project(again, fresh());
    OpenProject other(again, load_project(again), [this] { return mesh; });
    Segmentation segmentation = other.segmentation();
    std::size_t told = 0;
    const PlanReplay replayed =
        replay_plan(plan, other.project().scan, segmentation, other.project().settings, other.cache(),
                    [&](const Segmentation& s) {
                        ++told;
                        other.adopt(s);
                    },
                    {});
    EXPECT_TRUE(replayed.applies) << replayed.why;
    EXPECT_EQ(told, 4U);
    EXPECT_EQ(other.project().discards, project.project().discards);
    EXPECT_EQ(other.project().discarded, project.project().discarded);
    EXPECT_EQ(other.project().pieces, project.project().pieces);

    Plan elsewhere = plan;
    elsewhere.discards[1].inside = elsewhere.discards[1].inside + Vec3{1000, 0, 0};
    Segmentation start = uncut(mesh, 0);
    const PlanReplay refused = replay_plan(elsewhere, other.project().scan, start, other.project().settings,
                                           other.cache(), [](const Segmentation&) {}, {});
    EXPECT_FALSE(refused.applies);
    EXPECT_EQ(refused.why.find("discard of piece " + plan.discards[1].piece), 0U) << refused.why;
    EXPECT_EQ(start.cuts.size(), 1U);
}

TEST_F(Discarding, AndEveryOtherDecisionLeavesThePiecesThatStandIfTheyAreToBeWritten) {
    OpenProject project = open();
    const auto expect_written = [&] {
        std::set<std::string> names;
        for (const Piece& piece : project.segmentation().pieces) {
            names.insert(piece.name + ".ply");
            EXPECT_EQ(read_file(folder / "pieces" / (piece.name + ".ply")), to_ply(*piece.mesh));
        }
        EXPECT_EQ(piece_files(), names);
        EXPECT_EQ(load_project(folder).stage, Stage::cutting);
    };
    project.keep_pieces_written();
    expect_written();
    accept(project, 0);
    expect_written();
    project.decide_discard({project.segmentation().pieces.front().name});
    expect_written();
    project.undo();
    expect_written();
    project.redo();
    expect_written();
    project.decide_weights({1, 2, 3, 4});
    expect_written();
    project.decide_reset();
    expect_written();
    OpenProject without = open();
    accept(without, 0);
    EXPECT_TRUE(piece_files().empty()) << "they are of other decisions";
}

}  // namespace
}  // namespace qchopper
