#include "base/files/unfinished.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file) {
    std::ofstream(file) << "half";
}

// In a process of its own, because nothing may be listed afterwards.
TEST(Unfinished, WhatIsListedAtTheEndIsRemovedAndNothingElse) {
    const Folder folder;
    EXPECT_EXIT(
        {
            put(folder.path / "finished");
            put(folder.path / "file.tmp");
            fs::create_directory(folder.path / "folder.tmp");
            put(folder.path / "folder.tmp" / "inside");
            { const Unfinished done(folder.path / "finished"); }
            const Unfinished file(folder.path / "file.tmp");
            const Unfinished staged(folder.path / "folder.tmp");
            const Unfinished gone(folder.path / "missing");
            remove_unfinished_and_block();
            ::_exit(0);
        },
        testing::ExitedWithCode(0), "");
    EXPECT_TRUE(fs::exists(folder.path / "finished"));
    EXPECT_FALSE(fs::exists(folder.path / "file.tmp"));
    EXPECT_FALSE(fs::exists(folder.path / "folder.tmp"));
}

}  // namespace
}  // namespace qchopper
