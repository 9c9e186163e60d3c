#include "base/files/temporary_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Temporary files of the test lie in a folder of its own.
struct Temporary : ::testing::Test {
    fs::path parent = fs::path(testing::TempDir()) / ("temporary" + std::to_string(::getpid()));
    void SetUp() override {
        fs::create_directories(parent);
        ASSERT_EQ(::setenv("TMPDIR", parent.c_str(), 1), 0);
    }
    void TearDown() override {
        ::unsetenv("TMPDIR");
        fs::remove_all(parent);
    }
    std::ptrdiff_t count() const { return std::distance(fs::directory_iterator(parent), fs::directory_iterator{}); }
};

// A program that makes a folder with a file in it and is killed.
void be_killed() {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const TemporaryFolder folder("qchopper-some-");
        std::ofstream(folder.path() / "file") << "half";
        ::raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST_F(Temporary, AFolderIsThereAndGoneAfterwards) {
    {
        const TemporaryFolder folder("qchopper-some-");
        EXPECT_TRUE(fs::is_directory(folder.path()));
        EXPECT_EQ(folder.path().parent_path(), parent);
    }
    EXPECT_EQ(count(), 0);
}

TEST_F(Temporary, WhatAKilledRunLeftIsRemovedByTheNext) {
    be_killed();
    be_killed();
    EXPECT_EQ(count(), 1) << "the second removed what the first had left";
    const TemporaryFolder next("qchopper-some-");
    EXPECT_EQ(count(), 1);
    EXPECT_TRUE(fs::is_empty(next.path()));
}

TEST_F(Temporary, AFolderInUseAndAnybodyElsesStay) {
    const TemporaryFolder mine("qchopper-some-");
    fs::create_directory(parent / "qchopper-other-abcdef");
    fs::create_directory(parent / "elsewhere");
    std::ofstream(parent / "elsewhere" / "kept") << "x";
    fs::create_directory_symlink(parent / "elsewhere", parent / "qchopper-some-abcdef");
    const TemporaryFolder next("qchopper-some-");
    EXPECT_TRUE(fs::is_directory(mine.path()));
    EXPECT_TRUE(fs::is_directory(parent / "qchopper-other-abcdef"));
    EXPECT_TRUE(fs::exists(parent / "elsewhere" / "kept"));
}

}  // namespace
}  // namespace qchopper
