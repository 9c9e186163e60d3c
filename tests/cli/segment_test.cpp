// One decision at a time, every decision by a process of its own: what one saved the next one finds.

#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "segment/intake/write_ply.h"
#include "tests/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Segment : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    json answer(program::Arguments arguments) const {
        arguments.insert(arguments.begin(), "segment");
        arguments.insert(arguments.end(), {"--json", "-q"});
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(ended.out, nullptr, false);
    }
    std::vector<std::string> names(const json& told) const {
        std::vector<std::string> result;
        for (const json& piece : told["pieces"]) result.push_back(piece["name"]);
        return result;
    }
    double volume(const json& told) const {
        double sum = 0;
        for (const json& piece : told["pieces"]) sum += piece["volume_mm3"].get<double>();
        return sum;
    }
    void SetUp() override {
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
        begun = answer({"scan.ply", "--units", "mm", "-o", "p.qch"});
    }
    json begun;
};

TEST_F(Segment, ProposesWithoutCuttingAndAcceptsWhatWasProposed) {
    const std::string before = program::bytes_in(folder.path / "p.qch" / "project.json");
    const json proposed = answer({"p.qch", "--step", "--top", "5"});
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);  // prices may be kept beside it
    ASSERT_EQ(proposed["proposal"]["planes"].size(), 5U) << proposed.dump(1);
    const json accepted = answer({"p.qch", "--accept", "3"});
    ASSERT_EQ(accepted["cuts"].size(), 1U);
    EXPECT_EQ(accepted["cuts"][0]["terms"], proposed["proposal"]["planes"][2]["terms"]);
    EXPECT_EQ(accepted["cuts"][0]["offset_mm"], proposed["proposal"]["planes"][2]["offset_mm"]);
    EXPECT_NEAR(volume(accepted), volume(begun), 1e-9 * volume(begun));
}

TEST_F(Segment, PreviewsAPlaneWithoutCutting) {
    const program::Contents before = program::contents(folder.path);
    const json seen = answer({"p.qch", "--preview", "0,0,1,0"});
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
    const json made = answer({"p.qch", "--plane", "0,0,1,0"});
    EXPECT_EQ(seen["preview"]["makes"].size(), made["pieces"].size()) << seen.dump(1);
}

// A cavity that pokes out of its solid: planes through both say so before the cut, and the cut says it again.
TEST_F(Segment, SaysBeforeAndAfterTheCutWhereThePieceRunsThroughItself) {
    const TriangleMesh poking = shapes::joined(
        {shapes::box({0, 0, 0}, {40, 40, 40}, 2), shapes::turned_inside_out(shapes::ball({20, 20, 38}, 5))});
    write_file(folder.path / "poking.ply", to_ply(poking));
    answer({"poking.ply", "--units", "mm", "-o", "x.qch"});
    EXPECT_EQ(answer({"x.qch", "--preview", "1,0,0,0.1"})["preview"]["sections_cross"], true);
    EXPECT_EQ(answer({"x.qch", "--preview", "1,0,0,15.1"})["preview"]["sections_cross"], false);
    const std::string shown = run({"segment", "x.qch", "--preview", "1,0,0,0.1", "-q"}).out;
    EXPECT_NE(shown.find("The sections of this plane cross"), std::string::npos) << shown;
    const json proposed = answer({"x.qch", "--step", "--top", "118"});
    std::size_t crossing = 0;
    for (const json& plane : proposed["proposal"]["planes"]) crossing += plane["sections_cross"] == true ? 1 : 0;
    EXPECT_GT(crossing, 0U);
    EXPECT_LT(crossing, proposed["proposal"]["planes"].size());
    const program::Ended made = run({"segment", "x.qch", "--plane", "1,0,0,0.1", "-q"});
    EXPECT_EQ(made.code, 0);
    EXPECT_NE(made.err.find("intersects itself in 1 place"), std::string::npos) << made.err;
}

TEST_F(Segment, TakesBackTwoDecisionsAndBringsThemAgain) {
    const json one = answer({"p.qch", "--accept", "1"});
    const json two = answer({"p.qch", "--plane", "0,0,1,0", "--piece", one["pieces"][0]["name"]});
    EXPECT_EQ(two["undo"], "Undo cut 2 on piece " + one["pieces"][0]["name"].get<std::string>());
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], one["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], begun["pieces"]);
    EXPECT_EQ(run({"segment", "p.qch", "--undo"}).code, 1);  // nothing is left to take back
    EXPECT_EQ(answer({"p.qch", "--redo"})["pieces"], one["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--redo"})["pieces"], two["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--reset"})["pieces"], begun["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], two["pieces"]);
}

TEST_F(Segment, ChangesTheRankingWithTheWeights) {
    const json before = answer({"p.qch", "--step"});
    const json changed = answer({"p.qch", "--weights", "face_ratio=0,fragility=0,piece_count=0,undercut=1"});
    EXPECT_EQ(changed["weights"]["undercut"], 1);
    const json after = answer({"p.qch", "--step"});
    for (std::size_t k = 1; k < after["proposal"]["planes"].size(); ++k) {
        EXPECT_LE(after["proposal"]["planes"][k - 1]["terms"]["undercut"],
                  after["proposal"]["planes"][k]["terms"]["undercut"]);
    }
    EXPECT_NE(before["proposal"]["planes"], after["proposal"]["planes"]);
    EXPECT_EQ(answer({"p.qch", "--undo"})["weights"], begun["weights"]);
}

TEST_F(Segment, WritesAPlanThatMakesTheSamePiecesAgain) {
    answer({"p.qch", "--accept", "1"});
    const json cut = answer({"p.qch", "--accept", "2"});
    answer({"p.qch", "--plan", "cuts.plan"});
    const json replayed = answer({"scan.ply", "--units", "mm", "--replay", "cuts.plan", "-o", "again.qch"});
    EXPECT_EQ(replayed["pieces"], cut["pieces"]);
}

TEST_F(Segment, KeepsEveryDecisionWhenItIsKilled) {
    program::Process victim({"segment", "p.qch", "--auto", "--min-cuts", "40", "--json"}, {folder.path});
    ASSERT_TRUE(victim.waits_until_err("cut 3 on")) << victim.err();
    victim.signal(SIGKILL);
    EXPECT_EQ(victim.wait().killed_by, SIGKILL);
    const json found = answer({"p.qch"});
    EXPECT_GE(found["cuts"].size(), 3U);
    const double crumbs = 1e-5 * found["crumbs"].get<double>();  // each at most that share of the scan
    EXPECT_NEAR(volume(found), volume(begun), (1e-9 + crumbs) * volume(begun));
    EXPECT_EQ(answer({"p.qch", "--undo"})["cuts"].size(), found["cuts"].size() - 1);
}

TEST_F(Segment, RefusesWhatDoesNotMakeSenseAndChangesNothing) {
    const std::string before = program::bytes_in(folder.path / "p.qch" / "project.json");
    const std::vector<program::Arguments> wrong{
        {"--accept", "0"},        {"--accept", "1000"},     {"--plane", "0,0,0,1"},
        {"--plane", "1,2"},       {"--plane", "0,0,1,1e9"}, {"--piece", "Z", "--step"},
        {"--weights", "taste=1"}, {"--undo", "--redo"},     {"--replay", "no-such-plan"}};
    for (program::Arguments arguments : wrong) {
        const std::string what = arguments[0] + " " + arguments.back();
        arguments.insert(arguments.begin(), {"segment", "p.qch"});
        const program::Ended ended = run(arguments);
        EXPECT_NE(ended.code, 0) << what;
        EXPECT_FALSE(ended.err.empty()) << what;
    }
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);
}

}  // namespace
}  // namespace qchopper
