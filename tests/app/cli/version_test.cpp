// What the program says of its own version, and what jobs and verdicts record of it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "base/files/file.h"
#include "base/files/zip.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

TEST(Version, NamesTheBuildAndJobsRecordIt) {
    const program::Folder folder;
    const program::Ended asked = program::run({"--version"}, {folder.path});
    EXPECT_EQ(asked.code, 0);
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(asked.out, parts, std::regex("qchopper ([0-9]+\\.[0-9]+\\.[0-9]+\\+[0-9a-f]{12})\n")))
        << asked.out;
    const std::string job = (program::prepared() / "scan.qch" / "jobs" / "C.qjob").string();
    const Bytes manifest = unzip(read_file(job), job).at("manifest.json");
    const auto document = nlohmann::json::parse(manifest.begin(), manifest.end());
    EXPECT_EQ(document["program"]["version"], parts[1].str());
}

TEST(Version, OptionsThatEveryCommandHasAreInItsHelp) {
    const program::Folder folder;
    for (const char* command : {"sample", "fuse", "inspect", "repair", "prepare", "segment", "explain", "guide",
                                "export", "setup", "verify", "dry-run", "cell-sim", "dispatch", "schema"}) {
        const program::Ended help = program::run({command, "--help"}, {folder.path});
        for (const char* option : {"--json", "--quiet", "--progress", "--timings", "--threads"}) {
            EXPECT_NE(help.out.find(option), std::string::npos) << command << " " << option;
        }
    }
    const program::Ended none = program::run({"sample", "femur", "-o", "f.ply", "--threads", "0"}, {folder.path});
    EXPECT_EQ(none.code, 64) << none.err;
}

}  // namespace
}  // namespace qchopper
