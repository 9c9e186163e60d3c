#include "app/engine/outputs.h"

#include <gtest/gtest.h>

#include <map>

#include "app/engine/open_project.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "app/store/replay.h"
#include "base/files/temporary_folder.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

struct Outputs : ::testing::Test {
    TemporaryFolder temporary{"outputs"};
    fs::path folder = temporary.path();
    const TriangleMesh mesh = shapes::linked_tori();

    void SetUp() override {
        Project project;
        project.scan.volume_mm3 = volume_mm3(mesh);
        project.settings.candidates.offsets_per_normal = 5;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        save_project(folder, project);
    }

    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder / name).parent_path());
        write_file(folder / name, text);
    }
    void cut(std::size_t k = 0) const {
        OpenProject project = open();
        const std::size_t piece = *project.next({}).piece;
        const std::vector<Ranked> ranked = project.ranking(piece, 1, {});
        ASSERT_TRUE(project.decide_cut(cut_by(project.segmentation(), piece, ranked, k, project.project().settings)));
    }
    // As prepare does, with files that say of which cuts they are.
    void finish() const {
        OpenProject open = this->open();
        write_pieces(folder, open.segmentation(), FragmentChoice::keep);
        Project project = open.project();
        project.jobs.clear();
        for (const SolidRecord& piece : project.pieces) {
            write("jobs/" + piece.name + ".qjob", to_json(load_project(folder)) + piece.name);
            project.jobs.push_back({piece.name, Sha256{{0x11}}, std::string(32, 'a')});
        }
        write("pictures/exploded.png", std::to_string(project.cuts.size()));
        write("sheets.html", std::to_string(project.cuts.size()));
        project.stage = Stage::done;
        project.end_reason = EndReason::rules_hold;
        project.ended_because = "every piece fits";
        save_project(folder, project);
    }
    // All but what is kept aside, and the list of decisions, of which undo changes how many are in force.
    Files files() const {
        Files all;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const std::string name = fs::relative(entry.path(), folder).string();
            if (!entry.is_regular_file() || name.starts_with("cache") || name.starts_with("earlier")) continue;
            const Bytes bytes = read_file(entry.path());
            all[name] = {bytes.begin(), bytes.end()};
        }
        Project project = load_project(folder);
        project.history = {};
        all["project.json"] = to_json(project);
        return all;
    }
    std::size_t kept() const {
        const fs::directory_iterator all(folder / "earlier");
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
    void expect_none() const {
        EXPECT_EQ(load_project(folder).stage, Stage::cutting);
        EXPECT_TRUE(load_project(folder).jobs.empty());
        for (const auto& [name, bytes] : files()) EXPECT_TRUE(name == "project.json") << name;
    }
};

TEST_F(Outputs, AnUndoKeepsThemForRedo) {
    cut();
    cut();
    finish();
    const Files finished = files();
    const Project project = load_project(folder);
    ASSERT_TRUE(open().undo());
    expect_none();
    EXPECT_TRUE(are_outputs_kept(folder, project));
    ASSERT_TRUE(open().redo());
    EXPECT_EQ(files(), finished);
    EXPECT_EQ(load_project(folder), project);
    EXPECT_EQ(kept(), 0U);
}

TEST_F(Outputs, AnUndoOfANewDecisionBringsThemBack) {
    cut();
    finish();
    const Files first = files();
    cut();
    expect_none();
    finish();
    const Files second = files();
    ASSERT_TRUE(open().undo());
    EXPECT_EQ(files(), first);
    ASSERT_TRUE(open().redo());
    EXPECT_EQ(files(), second);
    ASSERT_TRUE(open().undo());
    ASSERT_TRUE(open().undo());
    expect_none();
    ASSERT_TRUE(open().redo());
    EXPECT_EQ(files(), first);
}

TEST_F(Outputs, AResetIsUndoneWithThem) {
    cut();
    finish();
    const Files finished = files();
    ASSERT_TRUE(open().decide_reset());
    expect_none();
    ASSERT_TRUE(open().undo());
    EXPECT_EQ(files(), finished);
}

TEST_F(Outputs, ThoseOfOtherDecisionsOrSettingsStayAside) {
    cut();
    finish();
    ASSERT_TRUE(open().undo());
    cut(3);  // another plane in its place
    ASSERT_TRUE(open().undo());
    ASSERT_TRUE(open().redo());
    expect_none();
    ASSERT_TRUE(open().undo());
    cut();  // the same plane as at first
    ASSERT_TRUE(open().undo());
    Project project = load_project(folder);
    project.settings.stop.max_unreachable = 0.25;
    save_project(folder, project);
    ASSERT_TRUE(open().redo());
    expect_none();
    ASSERT_TRUE(open().undo());
    project = load_project(folder);
    project.settings.stop.max_unreachable.reset();
    save_project(folder, project);
    ASSERT_TRUE(open().redo());
    EXPECT_EQ(load_project(folder).stage, Stage::done);
}

TEST_F(Outputs, OfTheNewestThreeTheyAreKept) {
    for (int i = 0; i < 5; ++i) {
        cut();
        finish();
    }
    EXPECT_EQ(kept(), 3U);
    for (int i = 0; i < 2; ++i) {  // the third place is that of the state which is left
        ASSERT_TRUE(open().undo());
        EXPECT_EQ(load_project(folder).stage, Stage::done) << i;
    }
    ASSERT_TRUE(open().undo());
    expect_none();
}

TEST_F(Outputs, WhatIsDamagedIsNotTaken) {
    cut();
    finish();
    ASSERT_TRUE(open().undo());
    for (const auto& entry : fs::directory_iterator(folder / "earlier")) write_file(entry.path() / "project.json", "{");
    write("earlier/of another kind", "");
    ASSERT_TRUE(open().redo());
    expect_none();
    EXPECT_EQ(load_project(folder).cuts.size(), 1U);
}

}  // namespace
}  // namespace qchopper
