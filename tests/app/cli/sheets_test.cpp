// sheets.html of a project: all setup sheets of its jobs, and never those of other jobs.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Sheets : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
    int code_of(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}).code; }
    fs::path file() const { return folder.path / "p.qch" / "sheets.html"; }
};

TEST_F(Sheets, HaveAPageForEveryJobAndStandAlone) {
    const std::string html = program::bytes_in(file());
    const json project = json::parse(program::bytes_in(folder.path / "p.qch" / "project.json"));
    ASSERT_GE(project["jobs"].size(), 2U);
    std::size_t number = 0;
    for (const json& job : project["jobs"]) {
        const std::string piece = job["piece"];
        ++number;
        EXPECT_NE(html.find("<a href=\"#sheet-" + std::to_string(number) + "\">" + piece + "</a>"), std::string::npos);
        EXPECT_NE(html.find("<h1>Setup sheet: piece " + piece + " ("), std::string::npos);
        EXPECT_NE(html.find("<td>" + piece + ".qjob</td>"), std::string::npos);
    }
    EXPECT_EQ(html.find("src=\"setup-"), std::string::npos) << "a picture that is not in it";
    EXPECT_NE(html.find("<td>jobs</td><td>" + std::to_string(number) + "</td>"), std::string::npos);
}

TEST_F(Sheets, FollowAnotherSetupAndItsUndoAndGoWithTheJobs) {
    const std::string before = program::bytes_in(file());
    const json project = json::parse(program::bytes_in(folder.path / "p.qch" / "project.json"));
    const std::string piece = project["jobs"][0]["piece"];
    ASSERT_EQ(code_of({"setup", "p.qch", "--piece", piece, "--orientations", "1", "-q"}), 0);
    EXPECT_NE(program::bytes_in(file()), before);
    ASSERT_EQ(code_of({"segment", "p.qch", "--undo", "-q"}), 0);
    EXPECT_FALSE(fs::exists(file())) << "the job of that piece is not written";
    ASSERT_EQ(code_of({"prepare", "p.qch", "-q"}), 0);
    EXPECT_EQ(program::bytes_in(file()), before);
    ASSERT_EQ(code_of({"segment", "p.qch", "--undo", "-q"}), 0);
    EXPECT_FALSE(fs::exists(file())) << "a cut is taken back";
}

}  // namespace
}  // namespace qchopper
