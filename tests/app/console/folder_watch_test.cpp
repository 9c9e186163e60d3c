#include "app/console/folder_watch.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct FolderWatchTest : ::testing::Test {
    Folder folder;
    fs::path project = folder.path / "p.qch";
    void SetUp() override { fs::create_directory(project); }
};

TEST_F(FolderWatchTest, TellsOfProjectsThatComeChangeAreLockedAndGo) {
    FolderWatch watch(folder.path);
    watch.add({project});
    EXPECT_FALSE(watch.wait(50ms));
    write_file(project / "project.json", std::string_view("{}"));
    EXPECT_TRUE(watch.wait(1h));
    {
        const ProjectLock lock(project);
        EXPECT_TRUE(watch.wait(1h));
    }
    EXPECT_TRUE(watch.wait(1h)) << "released";
    fs::create_directory(folder.path / "new.qch");
    EXPECT_TRUE(watch.wait(1h));
    watch.add({project, folder.path / "new.qch"});
    write_file(folder.path / "new.qch" / "project.json", std::string_view("{}"));
    EXPECT_TRUE(watch.wait(1h));
    EXPECT_FALSE(watch.wait(50ms)) << "all of it was told";
    fs::rename(folder.path / "new.qch", folder.path / "other.qch");
    EXPECT_TRUE(watch.wait(1h));
    fs::remove_all(project);
    EXPECT_TRUE(watch.wait(1h));
}

TEST_F(FolderWatchTest, WhoLooksAndOtherFilesOfAProjectAreNotTold) {
    { const ProjectLock lock(project); }
    FolderWatch watch(folder.path);
    watch.add({project});
    EXPECT_FALSE(writer_of(project));
    write_file(project / "report.txt", std::string_view("x"));
    EXPECT_FALSE(watch.wait(100ms));
}

TEST_F(FolderWatchTest, AStopEndsEveryWait) {
    FolderWatch watch(folder.path);
    std::thread stopper([&] {
        std::this_thread::sleep_for(100ms);
        watch.stop();
    });
    EXPECT_FALSE(watch.wait(1h));
    stopper.join();
    EXPECT_FALSE(watch.wait(1h));
}

TEST_F(FolderWatchTest, WhereNothingIsToldTheLimitEndsTheWait) {
    FolderWatch watch(folder.path / "gone");
    watch.add({folder.path / "gone" / "p.qch"});
    const Clock::time_point begin = Clock::now();
    EXPECT_FALSE(watch.wait(200ms));
    EXPECT_GE(Clock::now() - begin, 200ms);
}

}  // namespace
}  // namespace qchopper
