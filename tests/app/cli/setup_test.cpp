// qchopper setup: shows how pieces lie, and keeps what the operator chooses.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/store/project_folder.h"
#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SetupCommand : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
    program::Ended run(program::Arguments arguments) const { return program::run(arguments, {folder.path}); }
    json document_of(program::Arguments arguments) const {
        arguments.emplace_back("--json");
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(ended.out, nullptr, false);
    }
    json project() const { return json::parse(std::ifstream(folder.path / "p.qch" / "project.json")); }
};

TEST_F(SetupCommand, ShowsEveryPieceAndAllWaysToLayOne) {
    const json all = document_of({"setup", "p.qch"});
    EXPECT_EQ(all["schema"], "qchopper-setup-2");
    ASSERT_EQ(all["pieces"].size(), project()["pieces"].size());
    for (const json& piece : all["pieces"]) {
        const json one = document_of({"setup", "p.qch", "--piece", piece["name"]});
        ASSERT_EQ(one["pieces"].size(), 1U);
        EXPECT_EQ(one["pieces"][0], piece) << "alone and among all";
        EXPECT_GE(piece["setups"].size(), 1U);
        EXPECT_EQ(piece["setups"][0]["reach"]["method"], "mapped");
        EXPECT_EQ(piece["setups"][0]["reach"]["orientations"][0]["tilt_deg"], 0.0) << "the first one is straight up";
        for (const json& setup : piece["setups"]) {
            ASSERT_EQ(setup["margins_mm"].size(), 11U);
            bool is_in = true;
            for (const json& margin : setup["margins_mm"]) is_in = is_in && margin >= 0;
            EXPECT_EQ(setup["fits"], is_in) << setup;
        }
    }
    const program::Ended shown = run({"setup", "p.qch"});
    EXPECT_NE(shown.out.find("Arm not checked"), std::string::npos) << shown.out;
}

// Figure by figure, and nothing is decided before.
TEST_F(SetupCommand, APreviewedPlaneHasTheSetupsThatItHasOnceItIsDecided) {
    const std::string before = program::bytes_in(folder.path / "p.qch" / "project.json");
    const json preview = document_of({"segment", "p.qch", "--preview", "2", "--setups"})["preview"];
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);
    ASSERT_EQ(run({"segment", "p.qch", "--accept", "2"}).code, 0);
    const json decided = document_of({"setup", "p.qch"});
    EXPECT_EQ(preview["milled_pieces"]["cell"], decided["cell"]);
    EXPECT_EQ(preview["milled_pieces"]["max_unreachable"], decided["max_unreachable"]);
    std::size_t found = 0;
    for (const json& piece : decided["pieces"]) {
        for (json tried : preview["milled_pieces"]["pieces"]) {
            if (tried["name"] != piece["name"]) continue;
            ++found;
            EXPECT_EQ(tried["fits"], tried["setups"][0]["fits"]) << "the cell has no arm";
            for (const char* own : {"side", "fits", "areas_mm2"}) EXPECT_EQ(tried.erase(own), 1U) << own;
            EXPECT_EQ(tried, piece);
        }
    }
    EXPECT_EQ(found, preview["milled_pieces"]["pieces"].size());
    EXPECT_GE(found, 2U);
    EXPECT_FALSE(document_of({"segment", "p.qch", "--preview", "1"})["preview"].contains("milled_pieces"));
    EXPECT_EQ(run({"segment", "p.qch", "--step", "--setups"}).code, exit_use);
}

TEST_F(SetupCommand, ShowsAProjectThatAnotherProgramIsWriting) {
    const ProjectLock other(folder.path / "p.qch");
    const program::Ended shown = run({"setup", "p.qch"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    const program::Ended refused = run({"setup", "p.qch", "--piece", project()["pieces"][0]["name"], "--auto"});
    EXPECT_EQ(refused.code, exit_busy) << refused.err;
}

TEST_F(SetupCommand, KeepsTheOperatorsChoiceAndWritesTheJobAgain) {
    const json before = document_of({"setup", "p.qch"});
    const auto has_choice = [](const json& piece) { return piece["setups"].size() > 1; };
    const auto piece = std::find_if(before["pieces"].begin(), before["pieces"].end(), has_choice);
    ASSERT_NE(piece, before["pieces"].end());
    const std::string name = (*piece)["name"];
    const int other = (*piece)["setups"][1]["base_number"];
    const json jobs = project()["jobs"];

    const json changed =
        document_of({"setup", "p.qch", "--piece", name, "--base", std::to_string(other), "--orientations", "1"});
    EXPECT_EQ(changed["job_written"], true);
    EXPECT_EQ(changed["program"]["parts"], 0) << "the cell takes no programs";
    const json chosen = changed["pieces"][0]["setups"][0];
    EXPECT_EQ(chosen["base_number"], other);
    EXPECT_EQ(chosen["reach"]["orientations"].size(), 1U);
    EXPECT_EQ(changed["pieces"][0]["ordered"]["base_number"], other);
    ASSERT_EQ(project()["jobs"].size(), jobs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        EXPECT_EQ(project()["jobs"][i]["piece"], jobs[i]["piece"]) << "the order of the pieces";
        EXPECT_EQ(project()["jobs"][i] == jobs[i], jobs[i]["piece"] != name) << "only the job of this piece is new";
    }
    EXPECT_EQ(document_of({"setup", "p.qch", "--piece", name}), [&] {
        json same = changed;
        same["done"] = "";
        same["job_written"] = false;
        same.erase("program");
        return same;
    }());

    const json free = document_of({"setup", "p.qch", "--piece", name, "--auto"});
    EXPECT_EQ(free["pieces"][0], *piece);
    EXPECT_EQ(project()["jobs"], jobs) << "byte for byte the first job";
}

TEST_F(SetupCommand, UndoTakesTheChoiceBack) {
    const json before = document_of({"setup", "p.qch"});
    const std::string name = before["pieces"][0]["name"];
    ASSERT_EQ(run({"setup", "p.qch", "--piece", name, "--orientations", "1"}).code, 0);
    const program::Ended undone = run({"segment", "p.qch", "--undo"});
    EXPECT_EQ(undone.code, 0) << undone.err;
    EXPECT_NE(undone.out.find("Undo setup of piece " + name), std::string::npos) << undone.out;
    EXPECT_EQ(document_of({"setup", "p.qch"}), before);
    ASSERT_EQ(run({"segment", "p.qch", "--redo"}).code, 0);
    EXPECT_EQ(document_of({"setup", "p.qch", "--piece", name})["pieces"][0]["ordered"]["max_directions"], 1);
}

TEST_F(SetupCommand, WhatDoesNotExistIsRefused) {
    const std::string before = project().dump();
    const program::Ended piece = run({"setup", "p.qch", "--piece", "NONE"});
    EXPECT_EQ(piece.code, 64);
    EXPECT_NE(piece.err.find("no piece NONE"), std::string::npos) << piece.err;
    const std::string name = project()["pieces"][0]["name"];
    const program::Ended base = run({"setup", "p.qch", "--piece", name, "--base", "77"});
    EXPECT_EQ(base.code, 64);
    EXPECT_NE(base.err.find("has no base 77"), std::string::npos) << base.err;
    EXPECT_EQ(run({"setup", "p.qch", "--base", "1"}).code, 64) << "of which piece?";
    EXPECT_EQ(run({"setup", "p.qch", "--piece", name, "--base", "1", "--auto"}).code, 64);
    EXPECT_EQ(project().dump(), before);
}

// Two balls, the larger one wider than every block.
TEST_F(SetupCommand, APieceThatNoBlockHoldsIsNamedAndTheOthersGoOn) {
    const Bytes ply = to_ply(shapes::joined({shapes::ball({0, 0, 0}, 1100, 12), shapes::ball({2000, 0, 0}, 60, 8)}));
    program::put(folder.path / "balls.ply", {ply.begin(), ply.end()});
    const program::Ended made = run({"prepare", "balls.ply", "--units", "mm", "--cell", program::foam_cell().string(),
                                     "--max-faces", "100000", "-o", "balls.qch"});
    EXPECT_EQ(made.code, 1) << made.err;
    EXPECT_NE(made.err.find("piece A does not fit: "), std::string::npos) << made.err;
    EXPECT_NE(made.err.find(" mm too long for block long (2000 x 1000 x 1000 mm)"), std::string::npos) << made.err;
    EXPECT_FALSE(fs::exists(folder.path / "balls.qch" / "jobs" / "A.qjob"));
    EXPECT_TRUE(fs::exists(folder.path / "balls.qch" / "jobs" / "B.qjob"));
    const json shown = document_of({"setup", "balls.qch"});
    ASSERT_EQ(shown["pieces"].size(), 2U);
    EXPECT_EQ(shown["pieces"][0]["setups"][0]["fits"], false);
    EXPECT_EQ(shown["pieces"][1]["setups"][0]["fits"], true);
    const program::Ended table = run({"setup", "balls.qch", "--piece", "A"});
    EXPECT_NE(table.out.find("  no\n"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("piece A does not fit: "), std::string::npos) << table.out;
}

// The lower half of a ball is out of reach however it is carved, and more of it with fewer directions.
TEST_F(SetupCommand, ASetupThatLeavesMoreOutOfReachThanMayBeIsWarnedOf) {
    const Bytes ply = to_ply(shapes::ball({0, 0, 0}, 40, 12));
    program::put(folder.path / "ball.ply", {ply.begin(), ply.end()});
    const std::string cell = (fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml").string();
    const program::Ended made = run(
        {"prepare", "ball.ply", "--units", "mm", "--cell", cell, "--min-cuts", "0", "--no-programs", "-o", "ball.qch"});
    ASSERT_LE(made.code, 1) << made.err;
    const std::string words = "of its surface is out of reach, more than ";
    const program::Ended decided = run({"setup", "ball.qch", "--piece", "A", "--orientations", "1"});
    EXPECT_EQ(decided.code, 0) << decided.err;
    EXPECT_NE(decided.err.find("warning: piece A: "), std::string::npos) << decided.err;
    EXPECT_NE(decided.err.find(words), std::string::npos) << decided.err;
    EXPECT_NE(decided.err.find("--piece A --auto"), std::string::npos) << decided.err;
    const program::Ended shown = run({"setup", "ball.qch"});
    EXPECT_NE(shown.err.find(words), std::string::npos) << shown.err;
    EXPECT_EQ(run({"setup", "p.qch"}).err.find(words), std::string::npos) << "a cell without a limit";
}

}  // namespace
}  // namespace qchopper
