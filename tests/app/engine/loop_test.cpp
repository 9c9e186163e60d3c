// The loop from a scan to jobs: what its observer is told, in which order, and that it goes on where it was ended.

#include "app/engine/loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Loop : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("loop" + std::to_string(::getpid()));
    const TriangleMesh mesh = shapes::torus({0, 0, 0}, 90, 30, 24);
    std::vector<std::string> told;  // by the observer

    void SetUp() override { make("foam-1"); }
    void TearDown() override { fs::remove_all(folder); }

    void make(const std::string& cell) const {
        fs::remove_all(folder);
        for (const char* part : {"pieces", "jobs", "pictures"}) fs::create_directories(folder / part);
        if (!cell.empty()) {
            fs::copy_file(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / (cell + ".toml"), folder / "cell.toml");
        }
        Project project;
        project.scan = {"/torus.ply", Sha256{{0xaa}},        Unit::mm,         1,
                        {0, 0, 0},    mesh.triangles.size(), volume_mm3(mesh), {}};
        project.settings.stop.min_cuts = 3;
        project.settings.candidates.offsets_per_normal = 5;
        project.history.weights_at_start = project.settings.objectives.weights;
        record(project, uncut(mesh, 0));
        save_project(folder, project);
    }
    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    LoopObserver observer() {
        LoopObserver o;
        o.on_decision = [this](const Segmentation& s, LoopStep step) {
            EXPECT_EQ(step, LoopStep::cut);
            EXPECT_EQ(load_project(folder).cuts.size(), s.cuts.size()) << "saved already";
            told.push_back("decision");
        };
        o.on_cut = [this](const std::optional<SearchEnd>& end) { told.emplace_back(end ? "end" : "nothing to cut"); };
        o.on_setup = [this](const Piece& piece, const PlacedSetup& setup) {
            EXPECT_FALSE(setup.choice.setups.empty());
            told.push_back("setup " + piece.name);
        };
        o.on_job = [this](const PieceReport& report) {
            EXPECT_TRUE(fs::exists(report.job));
            told.push_back("job " + report.name);
        };
        return o;
    }
    std::size_t count(const std::string& begin) const {
        return static_cast<std::size_t>(
            std::count_if(told.begin(), told.end(), [&](const std::string& t) { return t.starts_with(begin); }));
    }
};

TEST_F(Loop, TellsDecisionsThenSetupsThenJobs) {
    OpenProject project = open();
    const LoopResult result = run_loop(project, {LoopStep::jobs, {}, "test"}, observer(), {});
    ASSERT_TRUE(result.end);
    EXPECT_TRUE(result.end->is_finished());
    ASSERT_TRUE(result.prepared);
    const std::size_t pieces = result.prepared->pieces.size();
    EXPECT_GE(pieces, 3U);
    EXPECT_EQ(count("decision"), 3U);
    EXPECT_EQ(count("end"), 1U);
    EXPECT_EQ(count("setup "), pieces);
    EXPECT_EQ(count("job "), pieces);
    EXPECT_EQ(told.size(), 4 + 2 * pieces);
    EXPECT_EQ(std::set<std::string>(told.begin(), told.end()).size(), 2 + 2 * pieces) << "each piece once";
    EXPECT_EQ(told[3], "end");
    EXPECT_TRUE(told[3 + pieces].starts_with("setup "));
    EXPECT_TRUE(told[4 + pieces].starts_with("job "));
    EXPECT_EQ(load_project(folder).stage, Stage::done);
}

TEST_F(Loop, ASecondRunCutsNothing) {
    OpenProject project = open();
    run_loop(project, {LoopStep::jobs, {}, "test"}, {}, {});
    const Project first = project.project();
    OpenProject again = open();
    const LoopResult result = run_loop(again, {LoopStep::jobs, {}, "test"}, observer(), {});
    EXPECT_FALSE(result.end);
    EXPECT_EQ(told.front(), "nothing to cut");
    EXPECT_EQ(again.project().cuts, first.cuts);
    EXPECT_EQ(again.project().stage, Stage::done);
}

TEST_F(Loop, EndsAfterTheStepThatIsAskedFor) {
    make("");  // no cell, so no setups
    OpenProject project = open();
    for (const LoopStep last : {LoopStep::cut, LoopStep::review, LoopStep::cut_again}) {
        const LoopResult result = run_loop(project, {last, {}, {}}, {}, {});
        EXPECT_EQ(result.end.has_value(), last == LoopStep::cut);
        EXPECT_FALSE(result.prepared);
        EXPECT_EQ(project.project().stage, Stage::cut);
    }
    EXPECT_THROW(run_loop(project, {LoopStep::jobs, {}, "test"}, {}, {}), InputError);
}

TEST_F(Loop, WhatIsCancelledAnywhereGoesOnToTheSameCuts) {
    const fs::path copy = folder.string() + ".copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    {
        OpenProject project = open();
        run_loop(project, {LoopStep::jobs, {}, "test"}, {}, {});
    }
    const Project whole = load_project(folder);
    fs::remove_all(folder);
    fs::rename(copy, folder);
    std::atomic<bool> stop = false;
    Context context;
    context.cancelled = &stop;
    LoopObserver stopping;
    stopping.on_decision = [&](const Segmentation& s, LoopStep) { stop = s.cuts.size() == 2; };
    stopping.on_setup = [&](const Piece&, const PlacedSetup&) { stop = true; };
    for (int run = 0; run < 2; ++run) {
        stop = false;
        OpenProject project = open();
        EXPECT_THROW(run_loop(project, {LoopStep::jobs, {}, "test"}, stopping, context), Cancelled) << run;
        EXPECT_EQ(load_project(folder).cuts.size(), run == 0 ? 2U : 3U) << "what was decided is kept";
    }
    stop = false;
    OpenProject project = open();
    run_loop(project, {LoopStep::jobs, {}, "test"}, {}, context);
    EXPECT_EQ(project.project().cuts, whole.cuts);
    EXPECT_EQ(project.project().pieces, whole.pieces);
    EXPECT_EQ(project.project().stage, Stage::done);
}

}  // namespace
}  // namespace qchopper
