// Programs that several processes made are those that prepare would have made.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "app/cli/exit_code.h"
#include "app/cli/local_engine.h"
#include "app/jobs/kept_programs.h"
#include "app/jobs/work_attempt.h"
#include "app/jobs/work_item.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Contents;
using program::Ended;

// A small vertebra, which a KUKA cell carves in few pieces: v.ply and kr60-ha.toml, and a project for each way to make
// its programs, made once per process.
const fs::path& sources() {
    static const program::Folder folder;
    static const bool is_made = [] {
        fs::copy(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml", folder.path / "kr60-ha.toml");
        return program::run({"sample", "vertebra", "--faces", "2000", "-o", "v.ply"}, {folder.path}).code == 0;
    }();
    EXPECT_TRUE(is_made);
    return folder.path;
}

fs::path project_by(const std::string& option) {
    const fs::path project = sources() / (option.substr(2) + ".qch");
    if (fs::exists(project)) return project;
    const Ended ended = program::run({"prepare", "v.ply", "--units", "mm", "--scale", "0.35", "--cell", "kr60-ha.toml",
                                      "-o", project.filename().string(), option},
                                     {sources()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return project;
}

struct ShardedWork : ::testing::Test {
    program::Folder folder;
    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    // `option` is --items or --programs.
    void prepare(const std::string& name, const std::string& option) const {
        fs::copy(project_by(option), folder.path / name, fs::copy_options::recursive);
    }
    void SetUp() override {
        for (const char* name : {"v.ply", "kr60-ha.toml"}) fs::copy(sources() / name, folder.path / name);
    }
    // Of attempts that are on record.
    std::ptrdiff_t attempts(const std::string& project) const {
        std::error_code error;
        const fs::directory_iterator records(folder.path / project / "work" / "attempts", error);
        return std::count_if(begin(records), end(records),
                             [](const auto& entry) { return entry.path().extension() == ".json"; });
    }
    // Sends a signal to a process as soon as it works on the largest piece.
    Ended ended_at_work(const std::string& project, int signal) const {
        const auto before = attempts(project);
        program::Process process({"work", project, "--threads", "1"}, {folder.path});
        for (int k = 0; k < 2000 && attempts(project) == before; ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        process.signal(signal);
        return process.wait();
    }
    std::string build() const {
        std::istringstream said(run({"--version"}).out);  // "qchopper 0.1.0+0123456789ab"
        std::string word;
        said >> word >> word;
        return word;
    }
    void kill_at_work(const std::string& project) const {
        const auto before = attempts(project);
        ASSERT_EQ(ended_at_work(project, SIGKILL).killed_by, SIGKILL);
        ASSERT_EQ(attempts(project), before + 1);
    }
    Contents without_cache(const std::string& project) const {
        Contents all = program::contents(folder.path / project);
        std::erase_if(
            all, [](const auto& file) { return file.first.starts_with("cache") || file.first.starts_with("work"); });
        return all;
    }
};

// Without cache and work, which are no result.
TEST_F(ShardedWork, OfShardsIsWhatPrepareMakesToTheByte) {
    prepare("whole.qch", "--programs");
    prepare("parts.qch", "--items");
    EXPECT_EQ(run({"work", "parts.qch", "--status", "--json"}).code, 0);
    // No scan is needed, and no lock: nothing but the items.
    fs::rename(folder.path / "v.ply", folder.path / "away.ply");
    fs::create_directories(folder.path / "elsewhere");
    fs::copy(folder.path / "parts.qch" / "work", folder.path / "elsewhere" / "work", fs::copy_options::recursive);
    // As on a processor without fused arithmetic, which gives sines and cosines other last digits.
    ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F", 1);
    const json one = json::parse(run({"work", "elsewhere", "--shard", "1/2", "--json", "--threads", "1"}).out);
    ::unsetenv("GLIBC_TUNABLES");
    const json other = json::parse(run({"work", "parts.qch", "--shard", "0/2", "--json"}).out);
    fs::copy(folder.path / "elsewhere" / "work" / "results", folder.path / "parts.qch" / "work" / "results",
             fs::copy_options::recursive);
    EXPECT_EQ(one["schema"], "qchopper-work-1");
    EXPECT_EQ(one["pieces"].size() + other["pieces"].size(), one["piece_count"]);
    EXPECT_EQ(one["piece_count"], other["piece_count"]);
    for (const json& piece : one["pieces"]) EXPECT_EQ(piece["kept"], false);
    for (const char* how : {"--status", "--shard=0/1"}) {
        const json again = json::parse(run({"work", "parts.qch", how, "--json"}).out);
        EXPECT_EQ(again["pieces"].size(), again["piece_count"]) << how;
        for (const json& piece : again["pieces"]) EXPECT_EQ(piece["kept"], true) << piece;
    }
    const Ended early = run({"dry-run", "parts.qch"});
    EXPECT_EQ(early.code, exit_use);
    EXPECT_NE(early.err.find("qchopper submit parts.qch"), std::string::npos) << early.err;
    const Ended gathered = run({"gather", "parts.qch"});  // without the scan
    EXPECT_EQ(gathered.code, 0) << gathered.err;
    EXPECT_NE(gathered.err.find("kept from an earlier run, of 0 made"), std::string::npos) << gathered.err;
    EXPECT_EQ(program::difference(without_cache("whole.qch"), without_cache("parts.qch")), "");
    // More shards than pieces, the last one first, after all that is kept is gone.
    for (const char* name : {"work/results", "cache"}) fs::remove_all(folder.path / "parts.qch" / name);
    for (int shard = 6; shard >= 0; --shard) {
        const std::string of_seven = std::to_string(shard) + "/7";
        EXPECT_EQ(run({"work", "parts.qch", "--shard", of_seven, "--threads", "2"}).code, 0) << of_seven;
    }
    EXPECT_EQ(run({"gather", "parts.qch"}).code, 0);
    EXPECT_EQ(program::difference(without_cache("whole.qch"), without_cache("parts.qch")), "");
}

// A result that is cut short, has another bit or is that of another piece is not used.
TEST_F(ShardedWork, DamagedItemsAndResultsAreNamedAndNotUsed) {
    prepare("p.qch", "--items");
    const fs::path items = folder.path / "p.qch" / "work" / "items";
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(items)) files.push_back(entry.path());
    ASSERT_GE(files.size(), 2U);
    std::sort(files.begin(), files.end());
    const std::string whole = program::bytes_in(files[0]);
    ASSERT_EQ(run({"work", files[1].string()}).code, 0) << "one item alone";
    EXPECT_EQ(json::parse(run({"work", files[1].string(), "--status", "--json"}).out)["pieces"].size(), 1U);
    EXPECT_TRUE(fs::exists(folder.path / "p.qch" / "work" / "results"));
    for (const std::string& damaged :
         {std::string(), whole.substr(0, whole.size() / 2), whole.substr(1), std::string("qchopper item 1")}) {
        program::put(files[0], damaged);
        const Ended work = run({"work", "p.qch"});
        EXPECT_EQ(work.code, exit_mesh) << work.err;
        EXPECT_NE(work.err.find(files[0].filename().string()), std::string::npos) << work.err;
    }
    program::put(files[0], whole);
    const Ended missing = run({"gather", "p.qch"});
    EXPECT_EQ(missing.code, exit_missing);
    EXPECT_NE(missing.err.find("no whole result of 1 piece: " + files[0].stem().string()), std::string::npos)
        << missing.err;
    const fs::path results = folder.path / "p.qch" / "work" / "results";
    const fs::path result = fs::directory_iterator(results)->path();
    std::string bytes = program::bytes_in(result);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    program::put(result, bytes);
    EXPECT_NE(run({"gather", "p.qch"}).err.find("no whole result of 2 pieces"), std::string::npos);
    const Ended made = run({"gather", "p.qch", "--make-missing"});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(run({"gather", "p.qch"}).code, exit_missing) << "the results are as they were";
}

TEST_F(ShardedWork, IsRefusedWhereItCannotBeDone) {
    EXPECT_EQ(run({"work", "none.qch"}).code, exit_missing);
    fs::copy(program::prepared() / "scan.qch", folder.path / "boxes.qch", fs::copy_options::recursive);
    const Ended boxes = run({"work", "boxes.qch"});
    EXPECT_EQ(boxes.code, exit_missing);
    EXPECT_NE(boxes.err.find("qchopper prepare boxes.qch --items"), std::string::npos) << boxes.err;
    const Ended items = run({"prepare", "boxes.qch", "--items"});
    EXPECT_EQ(items.code, exit_use);
    EXPECT_NE(items.err.find("no programs are made for"), std::string::npos) << items.err;
    for (const char* shard : {"2/2", "1/0", "1", "-1/2", "0.5/2", "a/b", "/", "0/1000001"}) {
        EXPECT_EQ(run({"work", "boxes.qch", "--shard", shard}).code, exit_use) << shard;
    }
}

TEST_F(ShardedWork, AreHandedToSlurmByAScript) {
    prepare("p.qch", "--items");
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", folder.path.c_str(), 1);
    const Ended none = run({"submit", "p.qch"});
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(none.code, exit_unreachable);
    EXPECT_NE(none.err.find("scontrol is not installed here"), std::string::npos) << none.err;
    EXPECT_EQ(run({"submit", "p.qch", "--shards", "2", "--print"}).code, 0);
    const std::string script = program::bytes_in(folder.path / "p.qch" / "work" / "slurm.sh");
    for (const char* part : {"#!/bin/sh\n", "--array=0,1 ", " --mem=1000M --time=10\n", "$SLURM_ARRAY_TASK_ID/2\"\n"}) {
        EXPECT_NE(script.find(part), std::string::npos) << part << " in " << script;
    }
    EXPECT_EQ(run({"submit", "p.qch", "--shards", "0"}).code, exit_use);
    EXPECT_EQ(run({"submit", "none.qch"}).code, exit_missing);
}

// The jobs are those of prepare, also after a process was killed in the middle.
TEST_F(ShardedWork, IsDoneByProcessesOnThisMachine) {
    prepare("whole.qch", "--programs");
    prepare("parts.qch", "--items");
    const fs::path work = folder.path / "parts.qch" / "work";
    kill_at_work("parts.qch");
    const json status = json::parse(run({"work", "parts.qch", "--status", "--json"}).out);
    EXPECT_GE(status["unmade"].size(), 1U);
    for (const json& piece : status["unmade"]) {
        EXPECT_TRUE(piece["last"].is_null() || piece["last"]["ended"] == true) << piece;
        EXPECT_LE(piece["failures"], 1) << piece;
    }
    EXPECT_EQ(run({"gather", "parts.qch"}).code, exit_missing);
    std::size_t lines = 0;
    std::istringstream failed(program::bytes_in(work / "failed.jsonl"));
    for (std::string line; std::getline(failed, line); ++lines) EXPECT_TRUE(json::parse(line).contains("piece"));
    EXPECT_EQ(lines, status["unmade"].size());
    const Ended done = run({"submit", "parts.qch", "--engine", "local", "--shards", "2"});
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_FALSE(fs::exists(work / "failed.jsonl"));
    EXPECT_TRUE(fs::exists(work / "local-1.log"));
    EXPECT_EQ(program::difference(without_cache("whole.qch"), without_cache("parts.qch")), "");
    EXPECT_EQ(run({"submit", "parts.qch", "--engine", "none"}).code, exit_use);
    for (const Arguments& wrong : {Arguments{"--memory", "100"}, Arguments{"--engine", "local", "--print"},
                                   Arguments{"--engine", "local", "--", "--partition=fast"}}) {
        Arguments arguments{"submit", "parts.qch"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run(arguments).code, exit_use) << wrong.back();
    }
}

TEST_F(ShardedWork, IsGivenUpAfterThreeFailures) {
    prepare("p.qch", "--items");
    for (int k = 0; k < 3; ++k) EXPECT_EQ(ended_at_work("p.qch", SIGTERM).code, exit_terminated);
    EXPECT_EQ(attempts("p.qch"), 0) << "a stop is no failure";
    EXPECT_EQ(run({"submit", "p.qch", "--print"}).code, 0);
    for (int k = 0; k < 3; ++k) kill_at_work("p.qch");
    const Ended others = run({"submit", "p.qch", "--print"});
    EXPECT_EQ(others.code, 0);
    EXPECT_NE(others.err.find("three attempts have failed to make"), std::string::npos) << others.err;
    const Ended work = run({"work", "p.qch", "--json"});
    EXPECT_EQ(work.code, exit_demand_broken) << work.err;
    const json answer = json::parse(work.out);
    EXPECT_EQ(answer["unmade"].size(), 1U);
    EXPECT_EQ(answer["pieces"].size() + 1, answer["piece_count"]) << "the others are made";
    const Ended refused = run({"submit", "p.qch", "--print"});
    EXPECT_EQ(refused.code, exit_use);
    EXPECT_NE(refused.err.find("submit p.qch --retry"), std::string::npos) << refused.err;
    EXPECT_EQ(run({"submit", "p.qch", "--print", "--retry"}).code, 0);
    EXPECT_NE(program::bytes_in(folder.path / "p.qch" / "work" / "slurm.sh").find(" --retry\n"), std::string::npos);
    EXPECT_EQ(run({"work", "p.qch", "--retry"}).code, 0);
}

TEST_F(ShardedWork, OfTwoProcessesOnOneItemAtOnceDoesNoHarm) {
    prepare("p.qch", "--items");
    const fs::path work = folder.path / "p.qch" / "work";
    const std::string item = (work / "items" / "B.qitem").string();
    program::Process first({"work", item, "--threads", "1"}, {folder.path});
    program::Process second({"work", item, "--threads", "1"}, {folder.path});
    EXPECT_EQ(first.wait().code, 0);
    EXPECT_EQ(second.wait().code, 0);
    std::size_t results = 0;
    for (const auto& entry : fs::directory_iterator(work / "results")) {
        EXPECT_EQ(entry.path().extension(), ".programs");
        ++results;
    }
    EXPECT_EQ(results, 1U);
}

// Another process has made something else of the same item meanwhile: a fault of the program or of a machine.
TEST_F(ShardedWork, OtherBytesOfOneItemAreAnErrorAndBothAreKept) {
    prepare("p.qch", "--items");
    const fs::path work = folder.path / "p.qch" / "work";
    const fs::path file = work / "items" / "B.qitem";
    const WorkItem item = item_from(read_file(file), file, build());
    program::Process process({"work", file.string(), "--threads", "1"}, {folder.path});
    // It has looked for a result before it is in a stage of the work.
    const auto is_at_work = [&] {
        const std::vector<SeenAttempt> seen = attempts_at(item.result, work / "attempts");
        return std::any_of(seen.begin(), seen.end(), [](const SeenAttempt& one) { return !one.attempt.stage.empty(); });
    };
    for (int k = 0; k < 4000 && !is_at_work(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    fs::create_directories(work / "results");
    keep_programs(work / "results" / item.result, {item.job, sha256(item.cell_file), item.fine},
                  {{}, "another machine says so", item.job.caps});
    const Ended ended = process.wait();
    EXPECT_EQ(ended.code, exit_internal) << ended.err;
    EXPECT_NE(ended.err.find("that were made twice differ"), std::string::npos) << ended.err;
    EXPECT_TRUE(fs::exists(work / "results" / item.result));
    EXPECT_TRUE(fs::exists((work / "results" / item.result).string() + ".second"));
}

TEST_F(ShardedWork, WhatTheArmRefusesIsNamedByGatherWithTheNextStep) {
    prepare("p.qch", "--items");
    const fs::path work = folder.path / "p.qch" / "work";
    const fs::path file = work / "items" / "B.qitem";
    const WorkItem item = item_from(read_file(file), file, build());
    PiecePrograms refused{{}, "no arm posture reaches it", item.job.caps};
    refused.is_machine_refusing = true;
    fs::create_directories(work / "results");
    keep_programs(work / "results" / item.result, {item.job, sha256(item.cell_file), item.fine}, refused);
    ASSERT_EQ(run({"work", "p.qch"}).code, 0);
    const Ended gathered = run({"gather", "p.qch"});
    EXPECT_EQ(gathered.code, exit_demand_broken);
    EXPECT_NE(gathered.err.find("piece B: no arm posture reaches it; it has to be cut again"), std::string::npos);
    EXPECT_NE(gathered.out.find("Next: qchopper prepare p.qch --items"), std::string::npos) << gathered.out;
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "jobs" / "B.qjob"));
    const json answer = json::parse(run({"gather", "p.qch", "--json"}).out);
    EXPECT_EQ(answer["schema"], "qchopper-work-1");
    EXPECT_EQ(answer["unmade"].size(), 0U);
    EXPECT_EQ(answer["pieces"].size(), answer["piece_count"]);
}

TEST_F(ShardedWork, WhereNothingCanBeWrittenIsToldSo) {
    prepare("p.qch", "--items");
    for (const char* name : {"attempts", "results"}) {
        const fs::path file = folder.path / "p.qch" / "work" / name;
        fs::remove_all(file);
        program::put(file, "a file");
        const Ended ended = run({"work", "p.qch"});
        EXPECT_EQ(ended.code, exit_create) << ended.err;
        EXPECT_NE(ended.err.find("cannot be created"), std::string::npos) << ended.err;
        fs::remove(file);
    }
}

TEST(LocalEngine, HasAsManyProcessesAsMemoryHolds) {
    const std::vector<ItemEstimate> items{{"A", 1, 3e9}, {"B", 1, 2e9}, {"C", 1, 1e9}, {"D", 1, 9e9, true}};
    EXPECT_EQ(processes_for(items, 8, 100e9), 3U) << "no more than pieces are left";
    EXPECT_EQ(processes_for(items, 2, 100e9), 2U);
    EXPECT_EQ(processes_for(items, 8, 5.5e9), 2U);
    EXPECT_EQ(processes_for(items, 8, 1e9), 1U);
}

TEST_F(ShardedWork, ADecisionRemovesItems) {
    prepare("p.qch", "--items");
    EXPECT_TRUE(fs::exists(folder.path / "p.qch" / "work" / "items"));
    ASSERT_EQ(run({"segment", "p.qch", "--undo"}).code, 0);
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "work"));
    EXPECT_EQ(run({"work", "p.qch"}).code, exit_missing);
    ASSERT_EQ(run({"prepare", "p.qch", "--items"}).code, 0);
    EXPECT_TRUE(fs::exists(folder.path / "p.qch" / "work" / "items"));
    const Ended setup = run({"setup", "p.qch", "--piece", "B", "--orientations", "1"});
    ASSERT_EQ(setup.code, 0) << setup.err;
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "work"));
}

TEST_F(ShardedWork, ItemsOfOtherPiecesOrOfAnotherCellAreNotGathered) {
    prepare("p.qch", "--items");
    const fs::path project = folder.path / "p.qch";
    ASSERT_EQ(run({"work", "p.qch"}).code, 0);
    const std::string cell = program::bytes_in(project / "cell.toml");
    program::put(project / "cell.toml", cell + "# edited\n");
    const Ended other_cell = run({"gather", "p.qch"});
    EXPECT_EQ(other_cell.code, exit_use) << other_cell.err;
    EXPECT_NE(other_cell.err.find("of another cell file"), std::string::npos) << other_cell.err;
    program::put(project / "cell.toml", cell);
    const fs::path item = project / "work" / "items" / "B.qitem";
    const std::string bytes = program::bytes_in(item);
    fs::remove(item);
    const Ended lacking = run({"gather", "p.qch"});
    EXPECT_EQ(lacking.code, exit_missing) << lacking.err;
    EXPECT_NE(lacking.err.find("are not those of its pieces"), std::string::npos) << lacking.err;
    EXPECT_FALSE(fs::exists(project / "jobs" / "B.qjob"));
    program::put(item, bytes);
    const fs::path attempt = fs::directory_iterator(project / "work" / "attempts")->path();
    json record = json::parse(program::bytes_in(attempt));
    EXPECT_EQ(record["libraries"].get<std::string>().substr(0, 7), "libpng ");
    record["libraries"] = "libpng 1.2.3";
    program::put(attempt, record.dump(2) + "\n");
    const Ended differing = run({"gather", "p.qch"});
    EXPECT_EQ(differing.code, 0);
    EXPECT_NE(differing.err.find("machines have other libraries"), std::string::npos) << differing.err;
    EXPECT_EQ(run({"gather", "p.qch"}).code, 0) << "once more";
    ASSERT_EQ(run({"prepare", "p.qch", "--items"}).code, 0);
    EXPECT_FALSE(fs::exists(project / "jobs" / "B.qjob")) << "its jobs are to be gathered again";
    EXPECT_EQ(run({"dry-run", "p.qch"}).code, exit_use);
}

}  // namespace
}  // namespace qchopper
