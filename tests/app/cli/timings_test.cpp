// --timings on every command: stages that add up to at most the whole, in the document only if it is given; and how
// long a progress line says that work will take.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/cli/terminal.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

TEST(TimeLeft, FollowsFromTheShareThatIsDone) {
    struct Case {
        std::size_t done;
        std::size_t total;
        double elapsed_s;
        const char* text;
    };
    const Case cases[] = {
        {1, 2, 10, ", about 10 s left"},
        {3, 4, 30, ", about 10 s left"},
        {37, 120, 12, ", about 27 s left"},  // 26.9
        {1, 4, 1, ", about 3 s left"},
        {999, 1000, 1, ", about 1 s left"},  // never 0 s
        {1, 11, 18, ", about 3 min left"},
        {1, 100, 3600, ", about 99 h 00 min left"},
        {1, 101, 3600, ""},  // nobody waits for that
        {1, 4, 0.99, ""},    // too early to tell
        {1, 4, 0, ""},
        {0, 4, 10, ""},  // nothing to estimate from
        {4, 4, 10, ""},  // done
        {5, 4, 10, ""},
        {5, 0, 10, ""},  // the total is not known
        {0, 0, 10, ""},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(time_left(c.done, c.total, c.elapsed_s), c.text)
            << c.done << " of " << c.total << " after " << c.elapsed_s << " s";
    }
}

struct TimingsOption : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    json timed(program::Arguments arguments) const {
        arguments.insert(arguments.end(), {"--json", "--timings"});
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_NE(ended.err.find("peak memory"), std::string::npos) << ended.err;
        return json::parse(ended.out, nullptr, false);
    }
};

// The document has plausible timings, with these stages among others.
void expect_timings(const json& document, const std::vector<std::string>& stages, const std::string& command) {
    ASSERT_TRUE(document.is_object()) << command;
    ASSERT_TRUE(document.contains("timings")) << command << ": " << document.dump();
    const json& timings = document["timings"];
    double sum_s = 0;
    std::vector<std::string> names;
    for (const json& stage : timings["stages"]) {
        names.push_back(stage["name"]);
        EXPECT_GE(stage["wall_s"], 0) << command;
        EXPECT_GE(stage["cpu_s"], 0) << command;
        sum_s += stage["wall_s"].get<double>();
    }
    EXPECT_LE(sum_s, timings["wall_s"].get<double>() + 1e-9) << command;
    EXPECT_GT(timings["wall_s"], 0) << command;
    EXPECT_GE(timings["cpu_s"], 0) << command;
    EXPECT_GT(timings["peak_memory_bytes"], 1'000'000) << command;
    for (const std::string& stage : stages) {
        EXPECT_EQ(std::count(names.begin(), names.end(), stage), 1)
            << command << ": " << stage << " is not in " << timings["stages"].dump();
    }
}

TEST_F(TimingsOption, OfEveryCommandOnScansAndProjects) {
    struct Case {
        program::Arguments arguments;
        std::vector<std::string> stages;
    };
    program::Arguments prepare = program::prepare_arguments("scan.ply");
    prepare.insert(prepare.end(), {"-o", "new.qch"});
    const Case cases[] = {
        {{"sample", "femur", "--faces", "4000", "-o", "f.ply"}, {"specimen made", "mesh written"}},
        {{"inspect", "scan.ply", "--units", "mm"}, {"scan read", "scan inspected"}},
        {{"repair", "scan.ply", "--units", "mm", "-o", "solid.ply"}, {"scan read", "scan repaired", "mesh written"}},
        {prepare,
         {"scan read", "scan repaired", "project saved", "search", "planes evaluated", "cuts made", "pieces written",
          "setups chosen", "jobs written", "sheets written", "pictures drawn"}},
        {{"segment", "scan.ply", "--units", "mm", "--preset", "thesis", "-o", "hand.qch"},
         {"scan read", "solids found", "project saved"}},
        {{"segment", "hand.qch", "--step"}, {"scan read", "planes ranked", "planes evaluated"}},
        {{"segment", "hand.qch", "--accept", "1"}, {"planes ranked", "cuts made", "project saved"}},
        {{"segment", "hand.qch", "--undo"}, {"cuts replayed", "project saved"}},
        {{"explain", "p.qch"}, {"scan read", "cuts replayed", "planes ranked"}},
        {{"guide", "p.qch"}, {"dowels placed", "guide drawn", "guide written"}},
        {{"export", "p.qch", "--format", "3mf"}, {"pieces read", "pieces written"}},
        {{"export", "p.qch", "--format", "stl", "--simplify", "0.05"}, {"pieces simplified", "pieces written"}},
        {{"dry-run", "p.qch"}, {"jobs read", "jobs handed over"}},
    };
    for (const Case& c : cases) expect_timings(timed(c.arguments), c.stages, c.arguments[0] + " " + c.arguments[1]);
}

TEST_F(TimingsOption, OfPrepareTellsToolpathProgramAndReplayApart) {
    const Bytes ply = to_ply(ball_cap());
    program::put(folder.path / "cap.ply", {ply.begin(), ply.end()});
    const std::string cell = (fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml").string();
    const program::Ended made = run({"prepare", "cap.ply", "--units", "mm", "--cell", cell, "--min-cuts", "0", "-o",
                                     "cap.qch", "--json", "--timings"});
    ASSERT_LE(made.code, 1) << made.err;
    expect_timings(json::parse(made.out, nullptr, false),
                   {"jobs written", "toolpaths made", "programs made", "programs replayed"}, "prepare");
}

TEST(ProgressText, IsACountOrPerCent) {
    EXPECT_EQ(progress_text({"planes evaluated", 2351, 10560}), "2,351 of 10,560 planes evaluated");
    EXPECT_EQ(progress_text({"planes evaluated", 2351, 0}), "2,351 planes evaluated");
    EXPECT_EQ(progress_text({"% of the job", 23, 100}), "23 % of the job");
    EXPECT_EQ(progress_text({"% of the job", 0, 100}), "0 % of the job");
}

TEST_F(TimingsOption, OfCellSimAndDispatch) {
    fs::create_directory(folder.path / "drop");
    program::Process cell(
        {"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed", "100000", "--json", "--timings"},
        {folder.path});
    ASSERT_TRUE(cell.waits_until_out("\n")) << cell.err();
    const json listening = json::parse(cell.out(), nullptr, false);
    expect_timings(listening, {}, "cell-sim");
    expect_timings(timed({"dispatch", "p.qch", "--piece", "C", "--to", listening["listening"], "--drop", "drop"}),
                   {"jobs read", "jobs handed over"}, "dispatch");
    cell.signal(SIGTERM);
    EXPECT_EQ(cell.wait().code, 0);
}

TEST_F(TimingsOption, IsTheOnlyDifferenceOfTheDocument) {
    const program::Ended without = run({"inspect", "scan.ply", "--json"});
    const program::Ended with = run({"inspect", "scan.ply", "--json", "--timings"});
    EXPECT_FALSE(json::parse(without.out).contains("timings"));
    EXPECT_EQ(without.err.find("peak memory"), std::string::npos);
    json document = json::parse(with.out);
    EXPECT_EQ(std::prev(document.end()).key(), "timings");
    document.erase("timings");
    EXPECT_EQ(document.dump(1) + "\n", without.out);
}

TEST_F(TimingsOption, PrintsATableAfterTheResult) {
    const program::Ended without = run({"inspect", "scan.ply", "--units", "mm"});
    const program::Ended with = run({"inspect", "scan.ply", "--units", "mm", "--timings", "--quiet"});
    EXPECT_EQ(with.out, without.out);
    for (const char* word : {"stage", "wall s", "CPU s", "share", "scan read", "scan inspected", "whole", "100.0 %"}) {
        EXPECT_NE(with.err.find(word), std::string::npos) << word << " is not in\n" << with.err;
        EXPECT_EQ(without.err.find(word), std::string::npos) << word;
    }
}

TEST_F(TimingsOption, LeavesTheDocumentOfAnErrorAsItIs) {
    const program::Ended with = run({"inspect", "none.ply", "--json", "--timings"});
    EXPECT_EQ(with.out, run({"inspect", "none.ply", "--json"}).out);
    EXPECT_NE(with.code, 0);
}

}  // namespace
}  // namespace qchopper
