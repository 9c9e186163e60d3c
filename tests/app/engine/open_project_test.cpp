#include "app/engine/open_project.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/files/file.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/search/candidates/size_candidates.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct OpenedProject : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("open" + std::to_string(::getpid()));
    const TriangleMesh mesh = shapes::linked_tori();

    void SetUp() override {
        fs::create_directories(folder);
        Project project;
        project.scan = {"/a bone.ply", Sha256{{0xbb}},        Unit::mm,         1,
                        {7, 8, 9},     mesh.triangles.size(), volume_mm3(mesh), {"it is yellow"}};
        project.settings.candidates.offsets_per_normal = 5;
        project.settings.stop.min_cuts = 3;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        save_project(folder, project);
    }
    void TearDown() override { fs::remove_all(folder); }

    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }

    // All of project.json but the history, and what stands by it.
    std::string committed() const {
        Project project = load_project(folder);
        EXPECT_EQ(bytes("project.json"), to_json(project));
        std::string text;
        for (const Cut& cut : project.cuts) text += cut.piece + std::to_string(cut.chosen.plane.offset) + " ";
        project.history = {};
        return text + to_json(project);
    }
    std::string bytes(const std::string& name) const {
        const Bytes b = read_file(folder / name);
        return {b.begin(), b.end()};
    }
    std::map<std::string, std::string> files_but_cache() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const std::string name = fs::relative(entry.path(), folder).string();
            if (entry.is_regular_file() && !name.starts_with("cache")) all[name] = bytes(name);
        }
        return all;
    }
    // The k-th candidate of the next piece, from 0.
    void accept(OpenProject& project, std::size_t k) const {
        const std::size_t piece = *project.next({}).piece;
        const std::vector<Ranked> ranked = project.ranking(piece, 1, {});
        EXPECT_TRUE(project.decide_cut(cut_by(project.segmentation(), piece, ranked, k, project.project().settings)));
    }
    // Cuts, a change of weights and a reset, and what stood before each.
    std::vector<std::string> decide_much(OpenProject& project) const {
        std::vector<std::string> before;
        const auto step = [&](const std::function<void()>& decide) {
            before.push_back(committed());
            decide();
        };
        step([&] { accept(project, 0); });
        step([&] { EXPECT_TRUE(project.decide_weights({1, 2, 3, 40})); });
        step([&] { accept(project, 4); });
        step([&] {
            const std::size_t piece = *piece_named(project.segmentation(), project.segmentation().pieces.front().name);
            const Vec3 c = bounds(*project.segmentation().pieces[piece].mesh).centre();
            const auto own = project.own_plane(piece, {{1, 0, 0}, c.x + 1}, {});
            ASSERT_TRUE(own);
            EXPECT_TRUE(
                project.decide_cut(cut_by(project.segmentation(), piece, {*own}, 0, project.project().settings)));
        });
        step([&] { EXPECT_TRUE(project.decide_reset()); });
        step([&] { accept(project, 2); });
        before.push_back(committed());
        return before;
    }
};

TEST_F(OpenedProject, UndoOfEveryDecisionGivesTheExactProjectOfBeforeAndRedoReturns) {
    std::vector<std::string> stood;
    {
        OpenProject project = open();
        stood = decide_much(project);
    }
    OpenProject project = open();  // undo and redo survive a reload
    for (std::size_t i = stood.size() - 1; i-- > 0;) {
        ASSERT_TRUE(project.undo());
        EXPECT_EQ(committed(), stood[i]) << i;
    }
    EXPECT_FALSE(project.undo());
    OpenProject again = open();
    for (std::size_t i = 1; i < stood.size(); ++i) {
        ASSERT_TRUE(again.redo());
        EXPECT_EQ(committed(), stood[i]) << i;
    }
    EXPECT_FALSE(again.redo());
}

TEST_F(OpenedProject, MemoryAndFileNeverDiffer) {
    OpenProject project = open();
    decide_much(project);
    EXPECT_EQ(project.project(), load_project(folder));
    for (int i = 0; i < 4; ++i) {
        project.undo();
        EXPECT_EQ(project.project(), load_project(folder));
        const Segmentation fresh = replay(load_project(folder), mesh);
        ASSERT_EQ(fresh.pieces.size(), project.segmentation().pieces.size());
        for (std::size_t p = 0; p < fresh.pieces.size(); ++p) {
            EXPECT_EQ(fresh.pieces[p].name, project.segmentation().pieces[p].name);
            EXPECT_EQ(*fresh.pieces[p].mesh, *project.segmentation().pieces[p].mesh);
        }
    }
}

TEST_F(OpenedProject, NamesArePutTheSameWayAfterUndo) {
    OpenProject project = open();
    accept(project, 0);
    const std::vector<SolidRecord> first = project.project().pieces;
    accept(project, 1);
    project.undo();
    project.undo();
    accept(project, 0);
    EXPECT_EQ(project.project().pieces, first);
}

TEST_F(OpenedProject, OfAPieceThatIsTooLargeTheRankingHasThePlanesForSizeThatTheSearchTakes) {
    Project changed = load_project(folder);
    changed.settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    changed.settings.objectives.scope = TermScope::cut;
    changed.settings.candidates.offsets_per_normal = 9;
    changed.settings.stop = {};
    changed.history.weights_at_start = changed.settings.objectives.weights;
    const Vec3 size = oriented_box(uncut(mesh, 0).pieces.front().mesh->points).size();
    changed.settings.stop.max_obb = Vec3{0.65 * size.x, 1.1 * size.y, 1.1 * size.z};
    save_project(folder, changed);
    OpenProject project = open();
    const std::size_t piece = *project.next(project.checks()).piece;
    const std::vector<Ranked> ranked = project.ranking(piece, 1, {});
    ASSERT_FALSE(ranked.empty());
    const Piece& target = project.segmentation().pieces[piece];
    const BlocksNeeded blocks = project.too_large_for(changed.settings, target);
    ASSERT_TRUE(blocks);
    const auto planes = candidates_for_size(project.cache().box(target), changed.settings.candidates, blocks);
    EXPECT_LT(planes.size(), 27U);
    for (const Ranked& r : ranked) {
        EXPECT_TRUE(
            planes.contains({static_cast<std::size_t>(r.normal_index), static_cast<std::size_t>(r.offset_index)}))
            << r.normal_index << " " << r.offset_index;
    }
    project.search(project.checks(), [](const Segmentation&) {}, {}, {});
    EXPECT_EQ(project.project().cuts.front().chosen.plane, ranked.front().plane);
}

TEST_F(OpenedProject, ARankingCutsNothingAndChangesNothingButTheCache) {
    OpenProject project = open();
    accept(project, 0);
    const auto before = files_but_cache();
    fs::remove_all(folder / "cache");
    OpenProject other = open();
    const std::size_t piece = *other.next({}).piece;
    const std::vector<Ranked> ranked = other.ranking(piece, 1, {});
    EXPECT_FALSE(ranked.empty());
    EXPECT_TRUE(other.own_plane(piece, ranked.front().plane, {}));
    EXPECT_EQ(files_but_cache(), before);
    EXPECT_TRUE(fs::exists(folder / "cache"));
    OpenProject third = open();
    EXPECT_EQ(third.ranking(piece, 1, {}), ranked);
    EXPECT_EQ(third.cache().evaluated_count(), 0U) << "another program need not evaluate again";
}

TEST_F(OpenedProject, AMissChangesNothing) {
    OpenProject project = open();
    const auto before = files_but_cache();
    EXPECT_FALSE(project.own_plane(0, {{0, 0, 1}, 1e6}, {}));
    EXPECT_TRUE(project.misses(0, {{0, 0, 1}, 1e6}));
    EXPECT_TRUE(project.misses(0, {{0, 0, 1}, -1e300}));
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen.plane = {{0, 0, 1}, 1e6};
    EXPECT_FALSE(project.decide_cut(cut));
    EXPECT_FALSE(project.decide_weights(project.project().settings.objectives.weights));
    EXPECT_FALSE(project.decide_reset());
    EXPECT_FALSE(project.undo());
    EXPECT_FALSE(project.redo());
    EXPECT_EQ(files_but_cache(), before);
}

TEST_F(OpenedProject, AnOwnPlaneIsNudgedOnceAndStoredExactly) {
    OpenProject project = open();
    const TriangleMesh& piece = *project.segmentation().pieces[0].mesh;
    const double through_a_vertex = piece.points[piece.points.size() / 3].x;
    const auto own = project.own_plane(0, {{1, 0, 0}, through_a_vertex}, {});
    ASSERT_TRUE(own);
    EXPECT_NE(own->plane.offset, through_a_vertex);
    EXPECT_NEAR(own->plane.offset, through_a_vertex, 1e-4);
    ASSERT_TRUE(project.decide_cut(cut_by(project.segmentation(), 0, {*own}, 0, project.project().settings)));
    EXPECT_EQ(load_project(folder).cuts.back().chosen.plane, own->plane);
}

TEST_F(OpenedProject, OutputsAreNeverStale) {
    OpenProject project = open();
    const SearchEnd end = project.search(
        {}, [](const Segmentation&) {}, {}, std::nullopt);
    EXPECT_TRUE(end.is_finished());
    EXPECT_EQ(load_project(folder).stage, Stage::cut);
    for (const Piece& piece : project.segmentation().pieces) {
        EXPECT_TRUE(fs::exists(folder / "pieces" / (piece.name + ".ply"))) << piece.name;
    }
    EXPECT_TRUE(project.decide_weights({1, 1, 1, 1}));
    EXPECT_EQ(load_project(folder).stage, Stage::cut) << "weights make no piece stale";
    fs::create_directories(folder / "jobs");
    write_file(folder / "jobs" / "A.qjob", std::string_view("old"));
    project.undo();
    project.undo();
    EXPECT_EQ(load_project(folder).stage, Stage::cutting);
    EXPECT_TRUE(fs::is_empty(folder / "pieces"));
    EXPECT_TRUE(fs::is_empty(folder / "jobs"));
}

TEST_F(OpenedProject, TheSearchGoesOnFromTheOperatorsCutsAndCanBeUndoneCutByCut) {
    OpenProject project = open();
    accept(project, 5);
    const std::string stood = committed();
    std::size_t rounds = 0;
    project.search(
        {}, [&](const Segmentation&) { ++rounds; }, {}, std::nullopt);
    EXPECT_EQ(rounds, 2U);
    EXPECT_EQ(load_project(folder).cuts.size(), 3U);
    project.undo();
    project.undo();
    EXPECT_EQ(committed(), stood);
}

TEST_F(OpenedProject, ASearchThatIsStoppedKeepsWhatWasDecided) {
    for (const std::size_t beam : {1U, 3U}) {
        OpenProject project = open();
        StopRules rules;
        rules.min_cuts = 50;
        project.set_search(rules, beam);
        std::atomic<bool> stop{false};
        Context context;
        context.cancelled = &stop;
        const auto on_round = [&](const Segmentation& s) { stop = s.cuts.size() >= 3; };
        EXPECT_THROW(project.search({}, on_round, context, std::nullopt), Cancelled);
        EXPECT_EQ(load_project(folder).cuts.size(), 3U);
        EXPECT_EQ(load_project(folder).stage, Stage::cutting);
        OpenProject again = open();
        while (again.undo()) {
        }
        EXPECT_TRUE(load_project(folder).cuts.empty());
    }
}

// What stands in the folder after each decision of a search, and at its end.
struct Course {
    std::vector<std::string> saved;  // project.json after every decision
    std::map<std::string, std::string> end;
};

// A program that is killed leaves one of the saved files. A run that goes on from it, killed again after each
// decision or not, ends with the bytes of the program that was never interrupted.
TEST_F(OpenedProject, ASearchThatIsInterruptedEndsWithTheSameBytesForEveryWidth) {
    const auto search_on = [&](const std::function<void()>& on_round, const Context& context) {
        OpenProject project = open();
        project.search(
            {}, [&](const Segmentation&) { on_round(); }, context, std::nullopt);
    };
    for (const std::size_t beam : {1U, 2U, 3U, 5U, 9U}) {
        for (const bool has_cut_of_its_own : {false, true}) {
            fs::remove_all(folder);
            SetUp();
            {
                OpenProject project = open();
                if (has_cut_of_its_own) accept(project, 5);
                StopRules rules;
                rules.min_cuts = 5;
                rules.max_faces = mesh.triangles.size() / 3;  // some segmentations hold it sooner than others
                project.set_search(rules, beam);
            }
            Course whole;
            whole.saved.push_back(bytes("project.json"));
            search_on([&] { whole.saved.push_back(bytes("project.json")); }, {});
            whole.end = files_but_cache();
            ASSERT_GE(whole.saved.size(), 4U);
            for (std::size_t killed_after = 0; killed_after < whole.saved.size(); ++killed_after) {
                for (const auto& [name, text] : whole.end) fs::remove(folder / name);
                write_file(folder / "project.json", whole.saved[killed_after]);
                search_on([] {}, {});
                EXPECT_EQ(files_but_cache(), whole.end) << "beam " << beam << ", killed after " << killed_after;
            }
            for (const auto& [name, text] : whole.end) fs::remove(folder / name);
            write_file(folder / "project.json", whole.saved.front());
            for (bool is_stopped = true; is_stopped;) {
                is_stopped = false;
                std::atomic<bool> stop{false};
                Context context;
                context.cancelled = &stop;
                try {
                    search_on([&] { stop = true; }, context);
                } catch (const Cancelled&) {
                    is_stopped = true;
                }
            }
            EXPECT_EQ(files_but_cache(), whole.end) << "beam " << beam << ", stopped after every decision";
        }
    }
}

// The torus around x = 0 and what becomes of it is never better. Of the other one three cuts leave less out of reach;
// of what they make some becomes better and some does not.
UnreachableSurface some_out_of_reach(const Piece& piece) {
    const std::size_t cuts = piece.half_spaces.size();
    const Vec3 centre = bounds(*piece.mesh).centre();
    if (centre.x < 20) return {10'000.0 / static_cast<double>(1U << cuts), 0.1};
    constexpr double left[] = {10'000, 5000, 2200};
    if (cuts < 3) return {left[cuts], 0.05};
    return centre.z > 0 ? UnreachableSurface{} : UnreachableSurface{1100, 0.03};
}

// A trial is one decision: what is saved is a state before or after it, and a search that goes on ends alike.
TEST_F(OpenedProject, ASearchWithTrialsThatIsInterruptedEndsWithTheSameBytesForEveryWidth) {
    const PieceChecks checks{{}, some_out_of_reach};
    const auto search_on = [&](const std::function<void()>& on_round, std::optional<TimeLimit> time_limit) {
        return open().search(
            checks, [&](const Segmentation&) { on_round(); }, {}, time_limit);
    };
    for (const std::size_t beam : {1U, 2U, 3U}) {
        fs::remove_all(folder);
        SetUp();
        {
            OpenProject project = open();
            StopRules rules;
            rules.max_unreachable = 0.02;
            rules.max_cuts = 12;
            project.set_search(rules, beam);
        }
        Course whole;
        whole.saved.push_back(bytes("project.json"));
        const SearchEnd end = search_on([&] { whole.saved.push_back(bytes("project.json")); }, {});
        EXPECT_FALSE(end.is_finished());
        EXPECT_NE(end.sentence.find("three cuts changed that"), std::string::npos) << end.sentence;
        whole.end = files_but_cache();
        ASSERT_GE(whole.saved.size(), 3U) << beam << end.sentence;
        EXPECT_NE(whole.saved.back().find("\"reverted\""), std::string::npos) << "else the trials are made again";
        for (std::size_t killed_after = 0; killed_after < whole.saved.size(); ++killed_after) {
            for (const auto& [name, text] : whole.end) fs::remove(folder / name);
            write_file(folder / "project.json", whole.saved[killed_after]);
            EXPECT_EQ(to_json(load_project(folder)), whole.saved[killed_after]);
            search_on([] {}, {});
            EXPECT_EQ(files_but_cache(), whole.end) << "beam " << beam << ", killed after " << killed_after;
        }
        for (const auto& [name, text] : whole.end) fs::remove(folder / name);
        write_file(folder / "project.json", whole.saved.front());
        std::size_t runs = 1;
        for (; runs < 40 && search_on([] {}, TimeLimit{1e-9}).is_out_of_time(); ++runs) {
        }
        EXPECT_GE(runs, whole.saved.size());
        EXPECT_EQ(files_but_cache(), whole.end) << "beam " << beam << ", out of time after every decision";
    }
}

TEST_F(OpenedProject, ASearchWithTrialsCanBeUndoneCutByCut) {
    OpenProject project = open();
    StopRules rules;
    rules.max_unreachable = 0.02;
    project.set_search(rules, 1);
    std::vector<std::string> stood{committed()};
    std::vector<std::size_t> rounds;
    project.search({{}, some_out_of_reach}, [&](const Segmentation& s) { rounds.push_back(s.cuts.size()); }, {}, {});
    ASSERT_FALSE(rounds.empty());
    EXPECT_EQ(rounds.front(), 3U) << "a trial of three cuts is saved at once";
    EXPECT_FALSE(load_project(folder).beam) << "the search has ended";
    for (std::size_t cuts = load_project(folder).cuts.size(); cuts > 0; --cuts) {
        ASSERT_TRUE(project.undo());
        EXPECT_EQ(load_project(folder).cuts.size(), cuts - 1);
    }
    EXPECT_EQ(load_project(folder).pieces.size(), 2U);
    EXPECT_FALSE(project.undo());
}

TEST_F(OpenedProject, KnowsAgainWhyItsSearchEnded) {
    OpenProject project = open();
    StopRules rules;
    rules.min_cuts = 9;
    rules.max_cuts = 1;
    project.set_search(rules, 1);
    const SearchEnd end = project.search(
        {}, [](const Segmentation&) {}, {}, std::nullopt);
    const Project saved = load_project(folder);
    EXPECT_EQ(end.reason, EndReason::max_cuts);
    EXPECT_EQ(saved.end_reason, EndReason::max_cuts);
    EXPECT_EQ(saved.ended_because, end.sentence);
    EXPECT_FALSE(saved.do_rules_hold());
    EXPECT_EQ(saved.warnings.back(), early_end(end.sentence));
    EXPECT_EQ(saved, project.project());
    project.undo();
    EXPECT_EQ(load_project(folder).end_reason, std::nullopt);
    EXPECT_TRUE(load_project(folder).do_rules_hold());
}

TEST_F(OpenedProject, OutOfTimeItStaysBeingCut) {
    OpenProject project = open();
    const SearchEnd end = project.search(
        {}, [](const Segmentation&) {}, {}, TimeLimit{1e-9});
    EXPECT_TRUE(end.is_out_of_time());
    EXPECT_FALSE(end.is_finished());
    const Project saved = load_project(folder);
    EXPECT_EQ(saved.stage, Stage::cutting);
    EXPECT_EQ(saved.cuts.size(), 1U);
    EXPECT_TRUE(open()
                    .search(
                        {}, [](const Segmentation&) {}, {}, std::nullopt)
                    .is_finished());
}

// What the file says of a beam is held against the decisions that stand.
TEST_F(OpenedProject, ABeamThatIsNotOfItsDecisionsIsRefused) {
    OpenProject project = open();
    StopRules rules;
    rules.min_cuts = 40;
    project.set_search(rules, 3);
    project.search(
        {}, [](const Segmentation&) {}, {}, TimeLimit{1e-9});
    const Project saved = load_project(folder);
    ASSERT_TRUE(saved.beam);
    ASSERT_EQ(saved.beam->branches.size(), 3U);
    const auto refused = [&](const std::function<void(Project&)>& spoil) {
        Project spoilt = saved;
        spoil(spoilt);
        EXPECT_THROW(project_from_json(to_json(spoilt), "p"), InputError);
    };
    refused([](Project& p) { p.beam->branches.clear(); });
    refused([](Project& p) { std::swap(p.beam->branches[0], p.beam->branches[1]); });
    refused([](Project& p) { p.beam->branches[1].last = 99; });
    refused([](Project& p) { p.beam->cuts[0].after = 1; });
    refused([](Project& p) { p.beam->from = 1; });
    refused([](Project& p) { decide(p.history, Reset{}); });
    Project astray = saved;
    astray.beam->cuts.back().cut.piece = "QQ";
    save_project(folder, astray);
    EXPECT_THROW(open().search(
                     {}, [](const Segmentation&) {}, {}, std::nullopt),
                 InputError);
    save_project(folder, saved);
    const std::vector<std::function<void(OpenProject&)>> decisions{
        [&](OpenProject& p) { accept(p, 0); },
        [](OpenProject& p) {
            p.decide_weights({1, 2, 3, 4});
        },
        [](OpenProject& p) { p.undo(); },
        [](OpenProject& p) { p.decide_reset(); },
        [](OpenProject& p) { p.decide_discard({p.segmentation().pieces.front().name}); },
        [&](OpenProject& p) { p.set_search(rules, 2); }};
    for (const auto& decide_something : decisions) {
        save_project(folder, saved);
        OpenProject other = open();
        decide_something(other);
        EXPECT_FALSE(load_project(folder).beam) << "the beam is of other decisions";
    }
}

TEST_F(OpenedProject, TriedWeightsRankAsTheyWouldAfterTheyWereDecided) {
    const Weights tried{1, 2, 0, 90};
    const std::string before = bytes("project.json");
    std::vector<Ranked> by_tried;
    {
        OpenProject project = open();
        const std::vector<Ranked> in_force = project.ranking(0, 5, {});
        by_tried = project.ranking(0, 5, {}, tried);
        EXPECT_NE(by_tried, in_force);
        EXPECT_EQ(project.ranking(0, 5, {}), in_force) << "nothing of it stays";
        EXPECT_EQ(project.project(), load_project(folder));
        const Plane plane{{1, 0, 0}, bounds(*project.segmentation().pieces[0].mesh).centre().x};
        EXPECT_NE(project.own_plane(0, plane, {}, tried)->terms.total, project.own_plane(0, plane, {})->terms.total);
    }
    EXPECT_EQ(bytes("project.json"), before);
    OpenProject decided = open();
    decided.decide_weights(tried);
    EXPECT_EQ(decided.ranking(0, 5, {}), by_tried);
}

TEST_F(OpenedProject, TriedWeightsOfTermsThatAreNotKnownAreRefused) {
    OpenProject project = open();
    Weights tried = project.project().settings.objectives.weights;
    tried.unreachable = 10;  // the pieces have no samples
    EXPECT_THROW(project.ranking(0, 1, {}, tried), InputError);
    EXPECT_EQ(project.project(), load_project(folder));
}

TEST_F(OpenedProject, TheScanIsTakenInOnlyWhenSomethingAsks) {
    int taken = 0;
    OpenProject project(folder, load_project(folder), [&] {
        ++taken;
        return mesh;
    });
    project.decide_weights({9, 9, 9, 9});
    project.undo();
    project.redo();
    EXPECT_EQ(taken, 0);
    project.next({});
    EXPECT_EQ(taken, 1);
}

}  // namespace
}  // namespace qchopper
