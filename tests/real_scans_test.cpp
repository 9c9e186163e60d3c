#include "tests/real_scans.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace qchopper {
namespace {

struct RealScans : ::testing::Test {
    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("real_scans_" + std::to_string(::getpid()));
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    void list(const std::string& text) const { std::ofstream(folder / "MANIFEST.tsv") << text; }
};

constexpr const char* head = "file\tformat\tF\tclosed\tnotes\n";

TEST_F(RealScans, AreThoseThatAreClosedCleanAndSmall) {
    list(std::string(head) +
         "a.ply\tPLY ascii\t99\t1\tselfint=0\n"
         "open.ply\tPLY ascii\t99\t0\tselfint=0\n"
         "meets.ply\tPLY ascii\t99\t1\tselfint=7\n"
         "other.obj\tOBJ\t99\t1\tselfint=0\n"
         "large.stl\tSTL\t100\t1\tselfint=0\n"
         "b.stl\tSTL\t1\t1\tx; selfint=0 y\n");
    const std::vector<RealScan> scans = valid_scans(folder, 100);
    ASSERT_EQ(scans.size(), 2U);
    EXPECT_EQ(scans[0].file, "a.ply");
    EXPECT_EQ(scans[0].faces, 99U);
    EXPECT_EQ(scans[1].file, "b.stl");
}

TEST_F(RealScans, AMissingFolderIsNoneAndAMissingListAFault) {
    EXPECT_TRUE(valid_scans(folder / "not there", 100).empty());
    EXPECT_THROW(valid_scans(folder, 100), std::runtime_error);
    list("");
    EXPECT_THROW(valid_scans(folder, 100), std::runtime_error);
}

TEST_F(RealScans, AMissingColumnOrCellIsAFault) {
    for (const std::string name : {"file", "format", "F", "closed", "notes"}) {
        std::string text = head;
        text.replace(text.find(name), name.size(), "renamed");
        list(text + "a.ply\tPLY\t99\t1\tselfint=0\n");
        EXPECT_THROW(valid_scans(folder, 100), std::runtime_error) << name;
    }
    list(std::string(head) + "a.ply\tPLY\t99\t1\n");
    EXPECT_THROW(valid_scans(folder, 100), std::runtime_error);
}

TEST_F(RealScans, TheRealListIsReadWhereItIs) {
    if (!std::filesystem::exists(QCHOPPER_MESHES)) GTEST_SKIP() << "skipped: the real meshes are not here";
    EXPECT_GE(valid_scans(QCHOPPER_MESHES, 400'000).size(), 5U);
}

}  // namespace
}  // namespace qchopper
