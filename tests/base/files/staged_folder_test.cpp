#include "base/files/staged_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <set>
#include <string>

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Staged : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("staged" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    std::set<std::string> names() const {
        std::set<std::string> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.insert(entry.path().filename().string());
        return all;
    }
    // What a run leaves that is killed while it fills its folder.
    void leave_one(const std::string& name) const {
        const pid_t child = ::fork();
        if (child == 0) {
            const StagedFolder begun(folder / name);
            std::ofstream(begun.path() / "half a file") << "half";
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status));
    }
};

TEST_F(Staged, AppearsWholeAtItsPlaceOrNotAtAll) {
    {
        const StagedFolder given_up(folder / "a.qch");
        EXPECT_TRUE(fs::is_directory(given_up.path()));
        EXPECT_FALSE(fs::exists(folder / "a.qch"));
    }
    EXPECT_TRUE(names().empty());
    {
        StagedFolder made(folder / "a.qch");
        std::ofstream(made.path() / "file") << "whole";
        made.move_to_its_place();
    }
    EXPECT_EQ(names(), std::set<std::string>{"a.qch"});
    EXPECT_TRUE(fs::exists(folder / "a.qch" / "file"));
}

TEST_F(Staged, WhatAKilledRunLeftIsRemovedByTheNext) {
    leave_one("a.qch");
    EXPECT_EQ(names().size(), 1U);
    leave_one("b c.qch");
    EXPECT_EQ(names().size(), 1U) << "its own remains, that of the first is gone";
    { const StagedFolder next(folder / "a.qch"); }
    EXPECT_TRUE(names().empty());
}

TEST_F(Staged, WhatIsAliveOrLockedOrNotOursStays) {
    const StagedFolder alive(folder / "z.qch");
    leave_one("a.qch");
    ASSERT_EQ(names().size(), 2U);
    const std::string ours = *names().begin();
    std::string not_ours = ours;  // another checksum
    not_ours.back() = not_ours.back() == '0' ? '1' : '0';
    for (const std::string& name : {not_ours, ours.substr(0, ours.rfind('-')), std::string("a.qch.tmp.1-00000000"),
                                    std::string("my.tmp.notes")}) {
        fs::create_directory(folder / name);
    }
    const std::set<std::string> before = names();
    const int lock = ::open((folder / ours).c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(lock, LOCK_EX), 0);
    { const StagedFolder next(folder / "b.qch"); }
    EXPECT_EQ(names(), before) << "another process holds the lock";
    ::close(lock);
    { const StagedFolder next(folder / "b.qch"); }
    std::set<std::string> rest = before;
    rest.erase(ours);
    EXPECT_EQ(names(), rest);
}

TEST_F(Staged, ALinkWithSuchANameIsNotFollowed) {
    leave_one("a.qch");
    const fs::path ours = folder / *names().begin();
    fs::remove_all(ours);
    fs::create_directory(folder / "precious");
    std::ofstream(folder / "precious" / "file") << "precious";
    fs::create_directory_symlink(folder / "precious", ours);
    { const StagedFolder next(folder / "a.qch"); }
    EXPECT_TRUE(fs::exists(folder / "precious" / "file"));
}

}  // namespace
}  // namespace qchopper
