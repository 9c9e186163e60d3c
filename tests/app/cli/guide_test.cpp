// The assembly guide of a finished project.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/exit_code.h"
#include "app/store/project_folder.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using program::Ended;

struct GuideCommand : ::testing::Test {
    program::Folder folder;
    fs::path project = folder.path / "p.qch";

    void SetUp() override { fs::copy(program::prepared() / "scan.qch", project, fs::copy_options::recursive); }
    Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    bool is_there() const { return fs::exists(project / "guide.html") || fs::exists(project / "guide.pdf"); }
};

TEST_F(GuideCommand, WritesThreeFilesWithTheSameBytesEachTime) {
    const Ended first = run({"guide", "p.qch", "--json"});
    ASSERT_EQ(first.code, 0) << first.err;
    const auto document = nlohmann::json::parse(first.out);
    EXPECT_EQ(document["schema"], "qchopper-guide-1");
    EXPECT_EQ(document["pieces"], 3);
    EXPECT_EQ(document["steps"], 2);
    std::set<std::string> put_together;
    for (const auto& step : document["assembly"]) {
        for (const char* side : {"moved", "standing"}) {
            for (const auto& piece : step[side]) put_together.insert(piece.get<std::string>());
        }
    }
    EXPECT_EQ(put_together.size(), 3) << document["assembly"];
    const auto before = program::contents(project);
    for (const auto& file : document["files"]) EXPECT_TRUE(fs::exists(folder.path / file.get<std::string>())) << file;
    EXPECT_NE(program::bytes_in(project / "guide.html").find("Step 2 of 2"), std::string::npos);
    const Ended again = run({"guide", "p.qch", "--threads", "1"});
    EXPECT_EQ(again.code, 0);
    EXPECT_EQ(program::difference(before, program::contents(project)), "");
}

TEST_F(GuideCommand, IsNeverStale) {
    ASSERT_EQ(run({"guide", "p.qch"}).code, 0);
    const std::string bytes = program::bytes_in(project / "guide.pdf");
    ASSERT_EQ(run({"segment", "p.qch", "--undo"}).code, 0);
    EXPECT_FALSE(is_there());
    const Ended early = run({"guide", "p.qch"});
    EXPECT_EQ(early.code, exit_use) << early.err;
    EXPECT_NE(early.err.find("qchopper prepare p.qch"), std::string::npos) << early.err;
    ASSERT_EQ(run({"segment", "p.qch", "--redo"}).code, 0);
    EXPECT_EQ(program::bytes_in(project / "guide.pdf"), bytes) << "it comes back with the jobs";
    ASSERT_LE(run({"setup", "p.qch", "--piece", "C", "--orientations", "1"}).code, 1);
    EXPECT_FALSE(is_there());
}

TEST_F(GuideCommand, WaitsForNobodyAndSaysWhoWrites) {
    const ProjectLock other(project);
    const Ended busy = run({"guide", "p.qch"});
    EXPECT_EQ(busy.code, exit_busy);
    EXPECT_NE(busy.err.find(", process "), std::string::npos) << busy.err;
    EXPECT_FALSE(is_there());
}

TEST_F(GuideCommand, OfWhatIsNoProject) {
    EXPECT_EQ(run({"guide", "none.qch"}).code, exit_missing);
    fs::remove(project / "jobs" / "C.qjob");
    const Ended broken = run({"guide", "p.qch"});
    EXPECT_EQ(broken.code, exit_missing) << broken.err;
    EXPECT_FALSE(is_there());
}

}  // namespace
}  // namespace qchopper
