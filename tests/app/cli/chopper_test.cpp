// The objectives of Chopper with the real program: by name, saved, shown, and refused where they are wrong.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ChopperOptions : ::testing::Test {
    program::Folder folder;
    void SetUp() override { write_file(folder.path / "bar.ply", to_ply(shapes::box({0, 0, 0}, {400, 80, 70}, 6))); }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    program::Ended made(const program::Arguments& more) const {
        program::Arguments arguments{"segment", "bar.ply", "--units", "mm", "-o", "p.qch"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json project() const { return json::parse(program::bytes_in(folder.path / "p.qch" / "project.json")); }
};

TEST_F(ChopperOptions, ThePresetCutsUntilEveryPartFitsThePrintVolume) {
    ASSERT_EQ(made({"--preset", "chopper", "--print-volume", "110,90,90"}).code, 0);
    const program::Ended ended = run({"segment", "p.qch", "--auto"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.err.find("connector"), std::string::npos) << ended.err;
    const json state = project();
    EXPECT_GE(state["pieces"].size(), 4U);
    const json terms = state["history"]["decisions"][0]["cut"]["chosen"]["terms"];
    EXPECT_GE(terms["parts"].get<double>(), 1);
    EXPECT_GT(terms["seam"].get<double>(), 0);
    const program::Ended explained = run({"explain", "p.qch", "--cut", "1"});
    EXPECT_EQ(explained.code, 0) << explained.err;
    for (const char* term : {"parts x 1", "utilization x 0.05", "connector x 1", "seam x 0.1", "symmetry x 0.25"})
        EXPECT_NE(explained.out.find(term), std::string::npos) << term << "\n" << explained.out;
    EXPECT_EQ(explained.out.find("undercut"), std::string::npos) << explained.out;
}

TEST_F(ChopperOptions, StepShowsTheTermsThatHaveAWeightAndAcceptTakesThem) {
    ASSERT_EQ(made({"--preset", "thesis", "--weights", "seam=2,parts=1", "--print-volume", "110,90,90"}).code, 0);
    const program::Ended shown = run({"segment", "p.qch", "--step", "--top", "3"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_NE(shown.out.find("parts"), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("seam"), std::string::npos) << shown.out;
    EXPECT_EQ(shown.out.find("connector"), std::string::npos) << shown.out;
    EXPECT_EQ(run({"segment", "p.qch", "--accept", "1"}).code, 0);
    EXPECT_EQ(run({"segment", "p.qch", "--weights", "connector=1,seam=0"}).code, 0);
    const json weights = project()["settings"]["weights"];
    EXPECT_EQ(weights["connector"], 1);
    EXPECT_FALSE(weights.contains("seam"));
    EXPECT_EQ(run({"segment", "p.qch", "--accept", "1"}).code, 0);
    EXPECT_EQ(project()["pieces"].size(), 3U);
}

TEST_F(ChopperOptions, AWeightOfSymmetryNeedsTheSymmetryPlane) {
    ASSERT_EQ(made({"--preset", "thesis"}).code, 0);
    const json before = project();
    const program::Ended refused = run({"segment", "p.qch", "--weights", "symmetry=1", "--step"});
    EXPECT_EQ(refused.code, 64) << refused.err;
    EXPECT_NE(refused.err.find("make a new project with --symmetry"), std::string::npos) << refused.err;
    EXPECT_EQ(project(), before);
    fs::remove_all(folder.path / "p.qch");
    ASSERT_EQ(made({"--preset", "thesis", "--symmetry"}).code, 0);
    const program::Ended fine = run({"segment", "p.qch", "--weights", "symmetry=1", "--step", "--json"});
    EXPECT_EQ(fine.code, 0) << fine.err;
    EXPECT_TRUE(json::parse(fine.out)["proposal"]["planes"][0]["terms"].contains("symmetry")) << fine.out;
}

TEST_F(ChopperOptions, ACutWithAForbiddenValueSaysThatNoOtherWasLeft) {
    write_file(folder.path / "bar.ply", to_ply(shapes::box({0, 0, 0}, {15, 14, 13}, 2)));
    ASSERT_EQ(made({"--preset", "chopper", "--print-volume", "10,20,20", "--forbid", "fragility"}).code, 0);
    const program::Ended cut = run({"segment", "p.qch", "--accept", "1"});
    EXPECT_EQ(cut.code, 0) << cut.err;
    EXPECT_NE(cut.out.find("No plane without a forbidden value was left"), std::string::npos) << cut.out;
    EXPECT_EQ(project()["settings"]["forbidden"], json::array({"fragility"}));
}

TEST_F(ChopperOptions, WrongValuesAreRefusedInOneLine) {
    const std::vector<program::Arguments> wrong{{"--forbid", "parts"},         {"--forbid", "taste"},
                                                {"--print-volume", "10,20"},   {"--print-volume", "10,0.5,20"},
                                                {"--utilization", "some"},     {"--connector", "glue"},
                                                {"--weights", "connector=-1"}, {"--weights", "parts=1,parts=2"},
                                                {"--fragility", "breakable"},  {"--weights", "symmetry=nan"}};
    for (const program::Arguments& options : wrong) {
        const program::Ended ended = made(options);
        EXPECT_EQ(ended.code, 64) << options[0] << " " << options[1] << ended.err;
        EXPECT_NE(ended.err.find(options[0]), std::string::npos) << ended.err;
        EXPECT_FALSE(fs::exists(folder.path / "p.qch"));
    }
    ASSERT_EQ(made({"--preset", "thesis"}).code, 0);
    for (const program::Arguments& options :
         {program::Arguments{"--forbid", "fragility"}, {"--print-volume", "1,2,3"}, {"--connector", "ratio"}}) {
        const program::Ended ended = run({"segment", "p.qch", options[0], options[1]});
        EXPECT_NE(ended.code, 0);
        EXPECT_NE(ended.err.find("belongs to a new one"), std::string::npos) << ended.err;
    }
}

}  // namespace
}  // namespace qchopper
