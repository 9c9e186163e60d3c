// explain evaluates a cut again and finds what was found when it was decided.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Explain : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    json answer(const program::Arguments& arguments) const {
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.err, "");
        return json::parse(ended.out, nullptr, false);
    }
    // Those that stand, as project.json has them.
    std::vector<json> cuts() const {
        const json history = json::parse(program::bytes_in(folder.path / "p.qch" / "project.json"))["history"];
        std::vector<json> committed;
        for (std::size_t i = 0; i < history["committed"].get<std::size_t>(); ++i) {
            const json& decision = history["decisions"][i];
            if (decision.contains("reset")) committed.clear();
            if (decision.contains("cut")) committed.push_back(decision["cut"]);
        }
        return committed;
    }
    void SetUp() override {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
};

TEST_F(Explain, FindsAgainWhatWasFoundWhenTheCutWasDecided) {
    ASSERT_EQ(cuts().size(), 2U);
    for (const json& cut : cuts()) {
        const std::string number = std::to_string(cut["number"].get<int>());
        const json told = answer({"explain", "p.qch", "--cut", number, "--json", "-q"});
        EXPECT_EQ(told["schema"], "qchopper-explain-3");
        ASSERT_EQ(cut["runners_up"].size(), 9U);
        EXPECT_EQ(told["piece"], cut["piece"]);
        EXPECT_EQ(told["pieces"], cut["pieces"]);
        EXPECT_EQ(told["candidates"], cut["candidates"]);
        EXPECT_EQ(told["place"], 1);
        EXPECT_EQ(told["chosen"]["terms"], cut["chosen"]["terms"]);
        ASSERT_EQ(told["best"].size(), 10U);
        EXPECT_EQ(told["best"][0], told["chosen"]);
        for (std::size_t i = 0; i < cut["runners_up"].size(); ++i) {
            EXPECT_EQ(told["best"][i + 1]["terms"], cut["runners_up"][i]["terms"]);
            EXPECT_EQ(told["best"][i + 1]["offset_mm"], cut["runners_up"][i]["offset_mm"]);
        }
    }
}

TEST_F(Explain, WritesAPlotAndChangesNothingElse) {
    const program::Contents before = program::contents(folder.path);
    answer({"explain", "p.qch", "--json", "-q"});
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), " +p.qch/pictures/cut-2.svg");
    answer({"explain", "p.qch", "-o", "again.svg", "--json", "-q"});
    const std::string plot = program::bytes_in(folder.path / "again.svg");
    EXPECT_EQ(plot, program::bytes_in(folder.path / "p.qch" / "pictures" / "cut-2.svg"));
    EXPECT_EQ(plot.rfind("<?xml", 0), 0U);
    for (const char* word : {"Total", "Face ratio", "Fragility", "Piece count", "Undercut", "Normal 3", "chosen"}) {
        EXPECT_NE(plot.find(word), std::string::npos) << word;
    }
}

TEST_F(Explain, UsesTheWeightsOfThatDecision) {
    fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
    fs::remove_all(folder.path / "p.qch");
    EXPECT_EQ(run({"segment", "scan.ply", "--units", "mm", "--preset", "thesis", "-o", "p.qch", "-q"}).code, 0);
    EXPECT_EQ(run({"segment", "p.qch", "--accept", "2", "-q"}).code, 0);
    EXPECT_EQ(run({"segment", "p.qch", "--weights", "undercut=70,fragility=0", "-q"}).code, 0);
    EXPECT_EQ(run({"segment", "p.qch", "--accept", "1", "-q"}).code, 0);
    const std::vector<json> made = cuts();
    ASSERT_EQ(made.size(), 2U);
    const json first = answer({"explain", "p.qch", "--cut", "1", "--json", "-q"});
    EXPECT_EQ(first["weights"]["undercut"], 10);
    EXPECT_GE(first["place"], 2) << "of all planes, those beside the first one included";
    EXPECT_EQ(first["best"][1]["terms"], first["chosen"]["terms"]) << "of those that --step lists";
    EXPECT_EQ(first["chosen"]["terms"], made[0]["chosen"]["terms"]);
    const json second = answer({"explain", "p.qch", "--json", "-q"});
    EXPECT_EQ(second["weights"]["undercut"], 70);
    EXPECT_EQ(second["place"], 1);
    EXPECT_EQ(second["chosen"]["terms"], made[1]["chosen"]["terms"]);
}

TEST_F(Explain, SaysThatAPlaneIsTheOperatorsOwn) {
    EXPECT_EQ(run({"segment", "p.qch", "--reset", "-q"}).code, 0);
    EXPECT_EQ(run({"segment", "p.qch", "--plane", "1,1,0.3,5", "-q"}).code, 0);
    ASSERT_EQ(cuts().size(), 1U);
    const json told = answer({"explain", "p.qch", "--json", "-q"});
    EXPECT_EQ(told["place"], nullptr);
    EXPECT_EQ(told["chosen"]["terms"], cuts()[0]["chosen"]["terms"]);
    EXPECT_NE(told["explanation"].get<std::string>().find("operator's own"), std::string::npos);
    const std::string plot = program::bytes_in(folder.path / "p.qch" / "pictures" / "cut-1.svg");
    EXPECT_NE(plot.find("Own normal"), std::string::npos);
}

TEST_F(Explain, RefusesACutThatIsNotThere) {
    EXPECT_EQ(run({"explain", "p.qch", "--cut", "3"}).code, 64);
    EXPECT_EQ(run({"explain", "p.qch", "--cut", "0"}).code, 64);
    EXPECT_EQ(run({"explain", "p.qch", "-o", "plot.png"}).code, 64);
    EXPECT_EQ(run({"explain", "nothing.qch"}).code, 66);
    EXPECT_EQ(run({"segment", "p.qch", "--reset", "-q"}).code, 0);
    EXPECT_EQ(run({"explain", "p.qch"}).code, 64);
}

}  // namespace
}  // namespace qchopper
