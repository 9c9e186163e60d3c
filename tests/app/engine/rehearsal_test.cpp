// Jobs can be rehearsed while prepare writes others.

#include <gtest/gtest.h>

#include "app/dispatch/dispatch_jobs.h"
#include "app/engine/prepare_project.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Two balls beside each other are two pieces without a cut.
TriangleMesh two_balls() {
    TriangleMesh both = shapes::ball({0, 0, 0}, 20, 8);
    const TriangleMesh other = shapes::ball({60, 0, 0}, 15, 8);
    const auto first = static_cast<std::uint32_t>(both.points.size());
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (const Triangle& t : other.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return both;
}

ProjectChoices choices_in(const std::filesystem::path& folder) {
    write_file(folder / "scan.ply", to_ply(two_balls()));
    ProjectChoices choices;
    choices.scan = folder / "scan.ply";
    choices.mm_per_unit = 1;
    choices.settings.stop.min_cuts = 0;
    choices.folder = folder / "p.qch";
    choices.cell_file = std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "foam-1.toml";
    return choices;
}

TEST(Rehearsal, TakesTheJobsThatAreWrittenWhileOthersAreMade) {
    const Folder folder;
    const ProjectChoices choices = choices_in(folder.path);
    std::vector<std::size_t> ready;  // jobs, each time when one more is written
    ProjectContext context;
    context.on_progress = [&](const Progress& progress) {
        if (progress.what != "jobs written" || progress.done == 0) return;
        ready.push_back(jobs_of(choices.folder, {}, {}, true).jobs.size());
        EXPECT_FALSE(jobs_of(choices.folder, {}, {}, true).is_finished);
        EXPECT_THROW(jobs_of(choices.folder, {}, {}), InputError) << "none is dispatched yet";
    };
    const PreparedProject prepared = prepare_scan(choices, {"1.0", {}, true}, context);
    ASSERT_EQ(prepared.pieces.size(), 2U);
    EXPECT_EQ(ready, (std::vector<std::size_t>{1, 2}));
    const ProjectJobs jobs = jobs_of(choices.folder, {}, {});
    EXPECT_TRUE(jobs.is_finished);
    EXPECT_EQ(jobs.jobs.size(), 2U);
}

TEST(Rehearsal, OfAProjectWithoutAJobIsRefused) {
    const Folder folder;
    const ProjectChoices choices = choices_in(folder.path);
    prepare_scan(choices, {"1.0", {}, true}, {});
    Project project = load_project(choices.folder);
    project.stage = Stage::cut;
    const WrittenJob first = project.jobs.front();
    project.jobs.clear();
    save_project(choices.folder, project);
    EXPECT_THROW(jobs_of(choices.folder, {}, {}, true), InputError);
    project.jobs = {first};
    save_project(choices.folder, project);
    EXPECT_EQ(jobs_of(choices.folder, {}, {}, true).jobs.size(), 1U) << "the file of the other one is not recorded";
    EXPECT_THROW(jobs_of(choices.folder, "B", {}, true), InputError);
}

}  // namespace
}  // namespace qchopper
