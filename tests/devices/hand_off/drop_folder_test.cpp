#include "devices/hand_off/drop_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct DropFolder : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("drop" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    void put(const std::string& name) const { std::ofstream(folder / name) << "half"; }
    bool has(const std::string& name) const { return fs::exists(folder / name); }
};

const std::string left = staging_name("C.qjob", Uuid{1, 2, 3});

TEST_F(DropFolder, WhatAKilledDispatcherLeftIsRemovedAndNothingElse) {
    put(left);
    put(left + ".tmp.4711");
    for (const char* name : {"C.qjob", ".hidden", ".C.qjob", ".C.qjob.0001", "notes.tmp.1"}) put(name);
    fs::create_directory(folder / staging_name("D.qjob", Uuid{}));
    const DropFolderUse use(folder);
    EXPECT_FALSE(has(left));
    EXPECT_FALSE(has(left + ".tmp.4711"));
    for (const char* name : {"C.qjob", ".hidden", ".C.qjob", ".C.qjob.0001", "notes.tmp.1"}) EXPECT_TRUE(has(name));
    EXPECT_TRUE(has(staging_name("D.qjob", Uuid{})));
}

TEST_F(DropFolder, AFileOfADispatcherThatRunsStays) {
    std::optional<DropFolderUse> one(std::in_place, folder);
    put(left);
    {
        const DropFolderUse other(folder);
        EXPECT_TRUE(has(left));
    }
    one.reset();
    const DropFolderUse next(folder);
    EXPECT_FALSE(has(left));
}

TEST_F(DropFolder, WhatCannotTakeAFileIsNamed) {
    EXPECT_EQ(fault_of_drop_folder(folder), "");
    EXPECT_EQ(fault_of_drop_folder(folder / "no"), "there is no drop folder " + (folder / "no").string());
    put("file");
    EXPECT_EQ(fault_of_drop_folder(folder / "file"),
              "the drop folder " + (folder / "file").string() + " is not a folder");
    StagedFile staged;
    EXPECT_EQ(staged.stage(folder / "no", "C.qjob", Uuid{1}, {1, 2, 3}), fault_of_drop_folder(folder / "no"));
    EXPECT_FALSE(staged.is_staged());
}

TEST_F(DropFolder, AFolderThatIsGoneBeforeTheFileIsPutIsNamed) {
    StagedFile staged;
    ASSERT_EQ(staged.stage(folder, "C.qjob", Uuid{1}, {1, 2, 3}), "");
    fs::remove_all(folder);
    EXPECT_EQ(staged.put(), "there is no drop folder " + folder.string());
}

TEST_F(DropFolder, AMissingFolderIsNoFaultHere) {
    const DropFolderUse use(folder / "no");
    EXPECT_FALSE(has("no"));
}

}  // namespace
}  // namespace qchopper
