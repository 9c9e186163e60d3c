#include "app/store/project_folder.h"
#include "app/store/replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "app/store/project_json.h"
#include "base/error.h"
#include "base/files/file.h"
#include "segment/mesh/measure.h"
#include "tests/json_schema.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct ProjectFolder : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("project" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
};

Project searched_project(const TriangleMesh& mesh, Segmentation& segmentation) {
    Project project;
    project.scan = {"/scans/a bone.ply", Sha256{{0xaa}},   Unit::cm, 0.5, {1, 2.5, 1.0 / 3}, 12,
                    volume_mm3(mesh),    {"scaled by 0.5"}};
    project.preset = "bunny";
    project.settings.candidates.offsets_per_normal = 5;
    project.settings.objectives.fragility_form = FragilityForm::thesis;
    project.settings.objectives.weights.unreachable = 100;
    project.settings.objectives.scope = TermScope::cut;
    project.settings.objectives.tilt_deg = 30;
    project.settings.stop.count_narrow = true;
    project.settings.objectives.fragment_volume_mm3 = 1e-5 * volume_mm3(mesh);
    project.settings.stop.min_cuts = 3;
    project.settings.stop.max_obb = Vec3{1, 2, 3};
    project.settings.stop.combine = Stop::any;
    segmentation = uncut(mesh, project.settings.objectives.fragment_volume_mm3);
    EvaluationCache cache(project.settings.objectives, project.settings.candidates);
    search(segmentation, project.settings, cache, {}, [](const Segmentation&) {}, {});
    project.history.weights_at_start = project.settings.objectives.weights;
    record(project, segmentation);
    return project;
}

TEST_F(ProjectFolder, WhatIsSavedIsLoadedToTheLastBit) {
    Segmentation segmentation;
    const Project project = searched_project(shapes::nested(), segmentation);
    save_project(folder, project);
    EXPECT_EQ(load_project(folder), project);
    EXPECT_EQ(project.warnings, project.scan.warnings);
    Project decided = project;
    decide(decided.history, Reset{});
    decide(decided.history, WeightsChange{{1, 2, 3, 0.1}});
    decide(decided.history, SetupOrder{"B", {}, 3, {1, 4}});
    decided.history.committed = 1;
    decided.cuts = committed_cuts(decided.history);
    decided.settings.beam = 7;
    decided.tools = {2, 3, 4};
    decided.settings.near = 1.0 / 3;
    save_project(folder, decided);
    EXPECT_EQ(load_project(folder), decided);
    EXPECT_EQ(to_json(decided).find("max_unreachable"), std::string::npos) << "no key of a rule that is not set";
    decided.settings.stop.max_unreachable = 1.0 / 3;
    decided.beam = BeamState{decided.cuts.size(), {}, {{0, {"A", "C"}, {{"C", 3, 81200.1, 79000.5, true}}}}, {}};
    save_project(folder, decided);
    EXPECT_EQ(load_project(folder), decided);
    const SchemaJson schema = SchemaJson::parse(project_schema());
    decide(decided.history, Discards{{"A", 1}});
    decide(decided.history, Discards{{"A", 1}, {"B", 1}});
    for (const Project& valid : {project, decided}) {
        EXPECT_EQ(schema_faults(schema, SchemaJson::parse(to_json(valid))), std::vector<std::string>());
    }
}

TEST(ProjectJson, ThePageOfTheFormatHasTheKeysOfTheTables) {
    expect_keys_of_page("project-folder.md", "project      = ", {project_schema()},
                        {"project", "null", "true", "those", "of", "that", "are", "not"});
}

TEST_F(ProjectFolder, TheReasonOfTheEndIsAValueBesideItsSentence) {
    Segmentation segmentation;
    Project project = searched_project(shapes::nested(), segmentation);
    project.ended_because = "a sentence of any words";
    for (const EndReason reason : {EndReason::rules_hold, EndReason::no_rule, EndReason::no_plane,
                                   EndReason::passed_over, EndReason::max_cuts, EndReason::time_limit}) {
        project.end_reason = reason;
        save_project(folder, project);
        EXPECT_EQ(load_project(folder), project);
    }
    const std::string text = to_json(project);
    const std::string key = "\"end_reason\": ";
    const std::size_t at = text.find(key + "\"time_limit\"");
    ASSERT_NE(at, std::string::npos);
    for (const std::string& other : {key + "\"weather\"", key + "3", std::string("\"end\": \"time_limit\"")}) {
        std::string broken = text;
        broken.replace(at, key.size() + std::string("\"time_limit\"").size(), other);
        write_file(folder / "project.json", broken);
        EXPECT_THROW(load_project(folder), InputError) << other;
    }
}

TEST_F(ProjectFolder, ReplayGivesTheSamePiecesBitForBit) {
    const TriangleMesh mesh = shapes::linked_tori();
    Segmentation segmentation;
    const Project project = searched_project(mesh, segmentation);
    save_project(folder, project);
    const Segmentation again = replay(load_project(folder), mesh);
    ASSERT_EQ(again.pieces.size(), segmentation.pieces.size());
    EXPECT_EQ(again.cuts, segmentation.cuts);
    for (std::size_t i = 0; i < again.pieces.size(); ++i) {
        EXPECT_EQ(again.pieces[i].name, segmentation.pieces[i].name);
        EXPECT_EQ(*again.pieces[i].mesh, *segmentation.pieces[i].mesh);
    }
}

TEST_F(ProjectFolder, APlanThatDoesNotApplyIsRefused) {
    Segmentation segmentation;
    const Project project = searched_project(shapes::linked_tori(), segmentation);
    EXPECT_THROW(replay(project, shapes::ball({900, 0, 0}, 1)), InputError);
}

TEST_F(ProjectFolder, EveryBrokenProjectFileIsOneClearError) {
    Segmentation segmentation;
    const std::string text = to_json(searched_project(shapes::torus({0, 0, 0}, 40, 12), segmentation));
    for (std::size_t length = 0; length + 2 < text.size(); length += 97) {
        write_file(folder / "project.json", std::string_view(text).substr(0, length));
        EXPECT_THROW(load_project(folder), InputError) << length;
    }
    write_file(folder / "project.json", std::string_view("{\"schema\": \"other\"}"));
    EXPECT_THROW(load_project(folder), InputError);
    std::string too_many = text;
    too_many.replace(too_many.find("\"committed\": "), 13, "\"committed\": 9");
    write_file(folder / "project.json", too_many);
    EXPECT_THROW(load_project(folder), InputError) << "more decisions are in force than there are";
    fs::remove(folder / "project.json");
    EXPECT_THROW(load_project(folder), InputError);
}

TEST_F(ProjectFolder, AMalformedHashIsRefused) {
    Project project;
    project.jobs = {{"A", Sha256{{0xaa}}, std::string(32, '0')}};
    const std::string text = to_json(project);
    EXPECT_EQ(project_from_json(text, "p"), project);
    for (const Sha256& digest : {project.scan.sha256, project.jobs[0].sha256}) {
        const std::size_t at = text.find(to_hex(digest));
        ASSERT_NE(at, std::string::npos);
        for (const char* other : {"g", "A", "", "00"}) {
            std::string malformed = text;
            malformed.replace(at, 1, other);
            EXPECT_THROW(project_from_json(malformed, "p"), InputError) << other;
        }
    }
}

TEST_F(ProjectFolder, TheLockKeepsASecondWriterOut) {
    {
        const ProjectLock first(folder);
        EXPECT_THROW(ProjectLock second(folder), InputError);
    }
    EXPECT_NO_THROW(ProjectLock third(folder));
}

}  // namespace
}  // namespace qchopper
