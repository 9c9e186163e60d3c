// What serve replays of a job, by the command that it runs. The piece is the cap of a ball (tests/app/ball_cap.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/dispatch/replay_job.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Ended;

// Made once per process: a folder with the proven project p.qch of one piece.
const fs::path& proven() {
    static program::Folder folder;
    static bool is_made = false;
    if (std::exchange(is_made, true)) return folder.path;
    write_file(folder.path / "cap.ply", to_ply(ball_cap()));
    const fs::path cell = fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml";
    const Ended made = program::run({"prepare", "cap.ply", "--units", "mm", "--cell", cell.string(), "--preset",
                                     "thesis", "--max-cuts", "0", "-o", "p.qch"},
                                    {folder.path});
    EXPECT_EQ(made.code, 0) << made.err;
    return folder.path;
}

struct ReplayCommand : ::testing::Test {
    program::Folder folder;
    fs::path project = folder.path / "p.qch";
    fs::path job = project / "jobs" / "A.qjob";
    fs::path verdict = project / "jobs" / "A.verdict.json";

    ReplayCommand() {
        fs::copy(proven() / "p.qch", project, fs::copy_options::recursive);
        fs::copy(proven() / "cap.ply", folder.path / "cap.ply");
    }
    Ended run(Arguments more = {}) const {
        Arguments arguments{"console-replay", "p.qch", "--piece", "A", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return program::run(arguments, {folder.path});
    }
    json replayed(const Arguments& more = {}) const {
        const Ended ended = run(more);
        EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
        return json::parse(ended.out);
    }
    json error_of(const Arguments& more, int code) const {
        const Ended ended = run(more);
        EXPECT_EQ(ended.code, code) << ended.err << ended.out;
        json error = json::parse(ended.out);
        EXPECT_EQ(error.at("unchanged"), "No job was changed.");
        EXPECT_FALSE(error.at("to_do").get<std::string>().empty());
        return error;
    }
    std::size_t files_in_cache(const std::string& ending) const {
        std::error_code error;
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(project / "cache", error)) {
            if (entry.path().extension() == ending) ++count;
        }
        return count;
    }
};

double figure(const json& of_verdict, const std::string& key) {
    for (const json& row : of_verdict.at("figures")) {
        if (row.at("key") == key) return row.at("value");
    }
    ADD_FAILURE() << key;
    return 0;
}

TEST_F(ReplayCommand, HasTheTimeOfTheProofAndAllThatItNames) {
    const json replay = replayed();
    const json of_verdict = json::parse(program::bytes_in(verdict));
    EXPECT_EQ(replay.at("time_s").get<double>(), figure(of_verdict, "time_s"));
    EXPECT_EQ(replay.at("job"), of_verdict.at("job").at("sha256"));
    EXPECT_TRUE(replay.at("positive"));
    const json& stages = replay.at("stages");
    ASSERT_GT(stages.size(), 10U);
    ASSERT_LE(stages.size(), 25U);
    EXPECT_EQ(stages.front().at("seconds"), 0);
    EXPECT_EQ(stages.back().at("seconds"), replay.at("time_s"));
    EXPECT_NEAR(stages.back().at("removed_mm3").get<double>(), replay.at("removed_mm3").get<double>(), 1e-3);
    for (std::size_t i = 1; i < stages.size(); ++i) {
        EXPECT_GT(stages[i].at("seconds").get<double>(), stages[i - 1].at("seconds").get<double>());
        EXPECT_GE(stages[i].at("removed_mm3").get<double>(), stages[i - 1].at("removed_mm3").get<double>());
        EXPECT_TRUE(fs::exists(project / "cache" / "replay" / (stages[i].at("mesh").get<std::string>() + ".mesh")));
    }
    std::size_t points = 0;
    for (const json& section : replay.at("sections")) {
        points += section.at("points").get<std::size_t>();
        EXPECT_LE(section.at("orientation").get<std::size_t>(), replay.at("tool_axes").size());
    }
    EXPECT_EQ(stages.back().at("points"), points);
    EXPECT_TRUE(fs::exists(project / "cache" / "replay" / (replay.at("path").get<std::string>() + ".path")));
    EXPECT_FALSE(replay.at("deviation").is_null());
}

TEST_F(ReplayCommand, IsTheSameOfTheCacheAndOfAnyNumberOfThreads) {
    EXPECT_EQ(files_in_cache(".deviation"), 1U) << "prepare keeps what its proof found";
    const Ended first = run({"--threads", "1"});
    const program::Contents kept = program::contents(project / "cache" / "replay");
    EXPECT_EQ(run().out, first.out);
    fs::remove_all(project / "cache" / "replay");
    EXPECT_EQ(run({"--threads", "2"}).out, first.out);
    EXPECT_EQ(program::difference(kept, program::contents(project / "cache" / "replay")), "");
    // Made again where the deviation is gone, by the proof.
    fs::remove_all(project / "cache");
    EXPECT_EQ(run().out, first.out);
    EXPECT_EQ(files_in_cache(".deviation"), 1U);
}

TEST_F(ReplayCommand, AMeshThatIsGoneIsMadeAgain) {
    const json replay = replayed();
    const std::string name = replay.at("stages").at(3).at("mesh").get<std::string>() + ".mesh";
    fs::remove(project / "cache" / "replay" / name);
    EXPECT_EQ(replayed(), replay);
    EXPECT_TRUE(fs::exists(project / "cache" / "replay" / name));
}

TEST_F(ReplayCommand, AJobThatIsGoneOrChangedIsNotReplayed) {
    const std::string bytes = program::bytes_in(job);
    fs::remove(job);
    EXPECT_NE(error_of({}, exit_missing).at("to_do").get<std::string>().find("prepare"), std::string::npos);
    std::string changed = bytes;
    changed[changed.size() / 2] ^= 1;
    program::put(job, changed);
    error_of({}, exit_mesh);
}

TEST_F(ReplayCommand, AJobThatNobodyHasProvenIsNotReplayed) {
    fs::remove(verdict);
    const json error = error_of({}, exit_use);
    EXPECT_NE(error.at("error").get<std::string>().find("is not proven"), std::string::npos) << error;
    EXPECT_NE(error.at("to_do").get<std::string>().find("qchopper verify"), std::string::npos) << error;
    EXPECT_EQ(program::run({"verify", "p.qch"}, {folder.path}).code, 0);
    replayed();
}

TEST_F(ReplayCommand, AVerdictOnOtherBytesIsNone) {
    std::string text = program::bytes_in(verdict);
    const std::string of_cell = json::parse(text).at("cell").at("sha256");
    text.replace(text.find(of_cell), of_cell.size(), std::string(of_cell.size(), '0'));
    program::put(verdict, text);
    EXPECT_NE(error_of({}, exit_use).at("error").get<std::string>().find("has changed since"), std::string::npos);
}

TEST_F(ReplayCommand, TheDeviationThatIsKeptIsThatOfTheProof) {
    const JobToReplay to_replay({project, "A"}, {});
    const std::optional<JobDeviation> kept = to_replay.deviation({});
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->mm.size(), to_replay.about().mesh.triangles.size());
    EXPECT_TRUE(std::any_of(kept->mm.begin(), kept->mm.end(), [](float mm) { return mm > 0; }));
    fs::remove_all(project / "cache");
    EXPECT_EQ(to_replay.deviation({}), kept);
}

TEST_F(ReplayCommand, APartOrAPieceThatIsNotThereIsNamed) {
    EXPECT_NE(error_of({"--part", "2"}, exit_use).at("error").get<std::string>().find("part 2"), std::string::npos);
    EXPECT_EQ(program::run({"console-replay", "p.qch", "--piece", "Q"}, {folder.path}).code, exit_use);
}

}  // namespace
}  // namespace qchopper
