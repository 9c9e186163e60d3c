// What prepare and segment do where the operator names no preset: they cut for what a tilting tool reaches.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Defaults : ::testing::Test {
    program::Folder folder;
    void SetUp() override { fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply"); }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    // Ends with the exit code 0.
    program::Ended done(const program::Arguments& arguments) const {
        program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
        return ended;
    }
    program::Ended segmented(const program::Arguments& more = {}) const {
        program::Arguments arguments{"segment", "scan.ply", "--units", "mm", "-o", "p.qch"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return done(arguments);
    }
    json project(const std::string& name = "p.qch") const {
        return json::parse(program::bytes_in(folder.path / name / "project.json"));
    }
    static std::string cell(const std::string& name) {
        return (fs::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml")).string();
    }
};

TEST_F(Defaults, PrepareCutsUntilNothingMuchIsOutOfReach) {
    const program::Ended ended = done(
        {"prepare", "scan.ply", "--units", "mm", "--cell", program::foam_cell().string(), "-o", "p.qch", "--json"});
    const json made = json::parse(ended.out);
    EXPECT_EQ(made["stop_rules_hold"], true);
    EXPECT_GE(made["cuts"].size(), 1U);
    // By the setups of the jobs, whatever the search found on samples.
    for (const json& piece : made["pieces"]) {
        EXPECT_LE(piece["reach"]["unreachable_share"].get<double>(), 0.02) << piece.dump(1);
        EXPECT_TRUE(piece["out_of_reach"].empty()) << piece.dump(1);
    }
    const json settings = project()["settings"];
    EXPECT_EQ(project()["preset"], "carve");
    EXPECT_EQ(settings["weights"]["unreachable"], 100);
    EXPECT_EQ(settings["terms_over"], "cut");
    EXPECT_EQ(settings["offsets_per_normal"], 80);
    EXPECT_EQ(settings["stop"]["max_unreachable"], 0.02);
    EXPECT_EQ(settings["stop"]["fits_cell"], true);
    EXPECT_TRUE(fs::exists(folder.path / "p.qch" / "pictures" / "unreachable.png"));
    EXPECT_NE(ended.err.find("best of up to 10,560 planes, "), std::string::npos) << ended.err;
}

TEST_F(Defaults, SegmentKnowsNoCellUntilOneIsNamed) {
    const program::Ended begun = segmented();
    EXPECT_EQ(project()["preset"], "carve");
    EXPECT_EQ(project()["settings"]["stop"]["max_unreachable"], 0.02);
    EXPECT_EQ(project()["settings"]["stop"]["fits_cell"], false);
    EXPECT_FALSE(project()["settings"].contains("tilt_deg")) << "60 degrees";
    EXPECT_NE(begun.out.find("unreachable"), std::string::npos) << begun.out;
    EXPECT_NE(begun.out.find("along all directions within 60 degrees"), std::string::npos) << begun.out;
    const program::Ended told = done({"segment", "p.qch", "--cell", cell("gantry-3axis")});
    EXPECT_EQ(project()["settings"]["stop"]["fits_cell"], true);
    EXPECT_EQ(project()["settings"]["tilt_deg"], 0) << "no cut was made yet";
    EXPECT_EQ(told.err.find("warning"), std::string::npos) << told.err;
}

TEST_F(Defaults, ACellThatComesAfterACutDoesNotChangeTheTilt) {
    segmented();
    done({"segment", "p.qch", "--accept", "1", "-q"});
    done({"segment", "p.qch", "--undo", "-q"});
    const program::Ended told = done({"segment", "p.qch", "--cell", cell("gantry-3axis")});
    EXPECT_FALSE(project()["settings"].contains("tilt_deg"));
    EXPECT_EQ(project()["settings"]["stop"]["fits_cell"], true);
    EXPECT_NE(told.err.find("warning: the tool of this cell tilts by 0 degrees, but planes are ranked for 60 degrees"),
              std::string::npos)
        << told.err;
}

TEST_F(Defaults, ACellOfTheSameTiltIsNoCauseOfAWarning) {
    segmented();
    done({"segment", "p.qch", "--accept", "1", "-q"});
    const program::Ended told = done({"segment", "p.qch", "--cell", cell("kr60-ha")});
    EXPECT_EQ(told.err.find("warning"), std::string::npos) << told.err;
    EXPECT_FALSE(project()["settings"].contains("tilt_deg"));
}

TEST_F(Defaults, OtherRulesTakeThePlaceOfThoseOfCarve) {
    segmented({"--min-cuts", "1", "--cell", program::foam_cell().string()});
    const json stop = project()["settings"]["stop"];
    EXPECT_EQ(stop["min_cuts"], 1);
    EXPECT_EQ(stop["fits_cell"], false);
    EXPECT_FALSE(stop.contains("max_unreachable"));
    EXPECT_EQ(project()["settings"]["weights"]["unreachable"], 100);
}

TEST_F(Defaults, WhatIsNoRuleLeavesTheRulesOfCarve) {
    segmented({"--max-cuts", "7", "--count-narrow", "--cell", program::foam_cell().string()});
    const json stop = project()["settings"]["stop"];
    EXPECT_EQ(stop["max_cuts"], 7);
    EXPECT_EQ(stop["fits_cell"], true);
    EXPECT_EQ(stop["max_unreachable"], 0.02);
}

TEST_F(Defaults, WeightsAreSetOnTopOfCarve) {
    segmented({"--weights", "fragility=3"});
    const json weights = project()["settings"]["weights"];
    EXPECT_EQ(weights["fragility"], 3);
    EXPECT_EQ(weights["unreachable"], 100);
    EXPECT_EQ(project()["preset"], "carve");
}

TEST_F(Defaults, ThesisIsWhatThereWasWithoutAPreset) {
    segmented({"--preset", "thesis"});
    const json settings = project()["settings"];
    EXPECT_EQ(settings["weights"], (json{{"face_ratio", 10}, {"fragility", 5}, {"piece_count", 50}, {"undercut", 10}}));
    EXPECT_EQ(settings["offsets_per_normal"], 40);
    EXPECT_FALSE(settings.contains("terms_over"));
    EXPECT_FALSE(settings["stop"].contains("max_unreachable"));
}

TEST_F(Defaults, APlanBringsItsOwnObjectivesAndNoStopRule) {
    segmented();
    done({"segment", "p.qch", "--accept", "1", "-q"});
    done({"segment", "p.qch", "--plan", "p.plan", "-q"});
    done({"segment", "scan.ply", "--units", "mm", "--replay", "p.plan", "-o", "again.qch", "-q"});
    EXPECT_EQ(project("again.qch")["preset"], "");
    EXPECT_FALSE(project("again.qch")["settings"]["stop"].contains("max_unreachable"));
    EXPECT_EQ(project("again.qch")["pieces"], project()["pieces"]);
    const auto terms = [&](const std::string& name) -> json {
        return project(name)["history"]["decisions"][0]["cut"]["chosen"]["terms"];
    };
    const json made = terms("p.qch");
    const json replayed = terms("again.qch");
    for (const auto& [name, value] : made.items()) {
        EXPECT_NEAR(replayed[name].get<double>(), value.get<double>(), 1e-9)
            << name << ": over the pieces of the cut, as carve has it";
    }
}

TEST_F(Defaults, StepAndPreviewTellWhatEachPlaneLeavesOutOfReach) {
    segmented();
    const program::Ended step = done({"segment", "p.qch", "--step", "--top", "2"});
    EXPECT_NE(step.out.find("up to 10,560 planes, "), std::string::npos) << step.out;
    EXPECT_NE(step.out.find("unreachable: of the scan's surface, over all pieces"), std::string::npos) << step.out;
    const json proposed = json::parse(done({"segment", "p.qch", "--step", "--json"}).out)["proposal"];
    EXPECT_EQ(proposed["max_judged_planes"], 10560);
    EXPECT_LT(proposed["candidates"], 10560);
    double last = 0;
    std::map<int, std::vector<int>> offsets;  // by normal; of the refined plane too
    for (const json& plane : proposed["planes"]) {
        EXPECT_GE(plane["terms"]["total"].get<double>() + 1e-9, last);
        last = plane["terms"]["total"];
        for (const int other : offsets[plane["normal_index"]]) {
            EXPECT_GT(std::abs(plane["offset_index"].get<int>() - other), 1) << proposed.dump(1);
        }
        offsets[plane["normal_index"]].push_back(plane["offset_index"]);
    }
    const json third = json::parse(done({"segment", "p.qch", "--preview", "3", "--json"}).out)["preview"]["plane"];
    EXPECT_EQ(third["offset_mm"], proposed["planes"][2]["offset_mm"]) << "the place in the list of --step";
    const program::Ended preview = done({"segment", "p.qch", "--preview", "1"});
    EXPECT_NE(preview.out.find(" of the scan's surface would be out of reach, over all pieces."), std::string::npos)
        << preview.out;
}

// The shares that explain tells follow from the terms of the cut and from the state before and after it.
TEST_F(Defaults, ExplainTellsWhatThePlaneOpens) {
    const json before = json::parse(segmented({"--json"}).out);
    const json after = json::parse(done({"segment", "p.qch", "--accept", "1", "--json"}).out);
    const json told = json::parse(done({"explain", "p.qch", "--json"}).out);
    const json opened = told["opened"];
    const double scan = opened["scan_mm2"];
    EXPECT_NEAR(opened["unreachable_before_mm2"].get<double>(),
                before["pieces"][0]["unreachable_all_directions"].get<double>() * opened["piece_mm2"].get<double>(),
                1e-9 * scan)
        << "uncut, the piece has no base to be left out";
    EXPECT_NEAR(opened["unreachable_after_mm2"].get<double>() / scan,
                after["cuts"][0]["terms"]["unreachable"].get<double>(), 1e-9);
    // A refined plane lies along none of the 132 normals.
    const bool is_refined = told["chosen"]["normal_index"].get<int>() < 0;
    const int others = is_refined ? 132 : 131;
    EXPECT_EQ(opened["other_normals"], others);
    EXPECT_EQ(opened["other_planes"], others * 80);
    const std::string shown = done({"explain", "p.qch"}).out;
    EXPECT_NE(shown.find("By reach: the plane opens "), std::string::npos) << shown;
    const std::string planes = is_refined ? "Of 10,560 planes along 132" : "Of 10,480 planes along 131";
    EXPECT_NE(shown.find(planes + " other normals the best opens "), std::string::npos) << shown;
}

TEST_F(Defaults, PrepareLeavesOutWhatIsSmallerThanAVolumeNowOrLater) {
    const TriangleMesh three =
        shapes::joined({shapes::box({0, 0, 0}, {90, 80, 40}), shapes::box({120, 0, 0}, {140, 20, 20}),
                        shapes::box({160, 0, 0}, {190, 30, 30})});
    write_file(folder.path / "three.ply", to_ply(three));
    done({"prepare", "three.ply", "--units", "mm", "--cell", program::foam_cell(), "--discard", "below=10ml", "-o",
          "q.qch"});
    EXPECT_EQ(project("q.qch")["discarded"].size(), 1U);
    EXPECT_EQ(project("q.qch")["jobs"].size(), project("q.qch")["pieces"].size());
    const program::Ended later = done({"prepare", "q.qch", "--discard", "below=30ml"});
    EXPECT_NE(later.err.find("discarded after cut"), std::string::npos) << later.err;
    const json left = project("q.qch");
    double volume = 0;
    for (const json& piece : left["pieces"]) {
        EXPECT_GE(piece["volume_mm3"], 30'000);
        volume += piece["volume_mm3"].get<double>();
    }
    EXPECT_NEAR(volume, 90 * 80 * 40, 1) << "what was smaller than 30 ml was of the two small boxes";
    EXPECT_EQ(left["jobs"].size(), left["pieces"].size());
    const program::Ended all = run({"prepare", "q.qch", "--discard", "below=9l"});
    EXPECT_EQ(all.code, 64) << all.err;
    EXPECT_EQ(project("q.qch"), left);
}

}  // namespace
}  // namespace qchopper
