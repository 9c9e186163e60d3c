// Programs that several processes made are those that prepare would have made.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Contents;
using program::Ended;

struct ShardedWork : ::testing::Test {
    program::Folder folder;
    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    // A small vertebra, which a KUKA cell carves in few pieces.
    void prepare(const std::string& name, const Arguments& further) const {
        Arguments arguments{"prepare", "v.ply",  "--units",      "mm", "--scale",
                            "0.35",    "--cell", "kr60-ha.toml", "-o", name};
        arguments.insert(arguments.end(), further.begin(), further.end());
        const Ended ended = run(arguments);
        ASSERT_EQ(ended.code, 0) << ended.err;
    }
    void SetUp() override {
        fs::copy(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml", folder.path / "kr60-ha.toml");
        ASSERT_EQ(run({"sample", "vertebra", "--faces", "2000", "-o", "v.ply"}).code, 0);
    }
    Contents without_cache(const std::string& project) const {
        Contents all = program::contents(folder.path / project);
        std::erase_if(all, [](const auto& file) { return file.first.starts_with("cache"); });
        return all;
    }
};

TEST_F(ShardedWork, OfShardsIsWhatPrepareMakesToTheByte) {
    prepare("whole.qch", {"--programs"});
    prepare("parts.qch", {"--no-programs"});
    // As on a processor without fused arithmetic, which gives sines and cosines other last digits.
    ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F", 1);
    const json one = json::parse(run({"work", "parts.qch", "--shard", "1/2", "--json", "--threads", "1"}).out);
    ::unsetenv("GLIBC_TUNABLES");
    const json other = json::parse(run({"work", "parts.qch", "--shard", "0/2", "--json"}).out);
    EXPECT_EQ(one["schema"], "qchopper-work-1");
    EXPECT_EQ(one["pieces"].size() + other["pieces"].size(), one["piece_count"]);
    EXPECT_EQ(one["piece_count"], other["piece_count"]);
    for (const json& piece : one["pieces"]) EXPECT_EQ(piece["kept"], false);
    const json again = json::parse(run({"work", "parts.qch", "--json"}).out);
    EXPECT_EQ(again["pieces"].size(), again["piece_count"]);
    for (const json& piece : again["pieces"]) EXPECT_EQ(piece["kept"], piece["outcome"] != "none") << piece;
    const Ended prepared = run({"prepare", "parts.qch", "--programs"});
    EXPECT_EQ(prepared.code, 0) << prepared.err;
    EXPECT_NE(prepared.err.find("kept from an earlier run, of 0 made"), std::string::npos) << prepared.err;
    EXPECT_EQ(program::difference(without_cache("whole.qch"), without_cache("parts.qch")), "");
}

TEST_F(ShardedWork, IsRefusedWhereItCannotBeDone) {
    EXPECT_EQ(run({"work", "none.qch"}).code, exit_missing);
    fs::copy(program::prepared() / "scan.qch", folder.path / "boxes.qch", fs::copy_options::recursive);
    const Ended boxes = run({"work", "boxes.qch"});
    EXPECT_EQ(boxes.code, exit_use);
    EXPECT_NE(boxes.err.find("no programs are made for"), std::string::npos) << boxes.err;
    for (const char* shard : {"2/2", "1/0", "1", "-1/2", "0.5/2", "a/b", "/", "0/1000001"}) {
        EXPECT_EQ(run({"work", "boxes.qch", "--shard", shard}).code, exit_use) << shard;
    }
    ASSERT_EQ(run({"segment", "boxes.qch", "--undo"}).code, 0);
    const Ended cutting = run({"work", "boxes.qch"});
    EXPECT_EQ(cutting.code, exit_use);
    EXPECT_NE(cutting.err.find("qchopper prepare boxes.qch --no-programs"), std::string::npos) << cutting.err;
}

}  // namespace
}  // namespace qchopper
