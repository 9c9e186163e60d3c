// One decision at a time, every decision by a process of its own: what one saved the next one finds.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
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
        begun = answer({"scan.ply", "--units", "mm", "--preset", "thesis", "-o", "p.qch"});
    }
    json begun;
};

TEST_F(Segment, ProposesWithoutCuttingAndAcceptsWhatWasProposed) {
    const std::string before = program::bytes_in(folder.path / "p.qch" / "project.json");
    const json proposed = answer({"p.qch", "--step", "--top", "5"});
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);  // evaluations may be kept beside it
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
    answer({"poking.ply", "--units", "mm", "--preset", "thesis", "-o", "x.qch"});
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

TEST_F(Segment, TriesWeightsAndCutsOnlyThePlaneThatIsExpected) {
    const std::string before = program::bytes_in(folder.path / "p.qch" / "project.json");
    const std::string weights = "face_ratio=0,fragility=0,piece_count=0,undercut=1";
    const json tried = answer({"p.qch", "--step", "--try-weights", weights});
    EXPECT_EQ(tried["tried_weights"]["undercut"], 1);
    EXPECT_EQ(tried["weights"], begun["weights"]);
    const program::Ended said = run({"segment", "p.qch", "--step", "--try-weights", weights});
    EXPECT_NE(said.out.find("keep them by: qchopper segment p.qch --weights"), std::string::npos) << said.out;
    EXPECT_EQ(said.out.find("--accept"), std::string::npos) << "its places are those of another ranking";
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);
    const auto plane_of = [](const json& plane) {
        std::string text;
        for (const json& x : plane["normal"]) text += x.dump() + ",";
        return text + plane["offset_mm"].dump();
    };
    const std::string first = plane_of(tried["proposal"]["planes"][0]);
    const program::Ended other = run({"segment", "p.qch", "--accept", "1", "--expect-plane", first});
    EXPECT_EQ(other.code, 1) << other.err;
    EXPECT_NE(other.out.find("Another plane stands at place 1"), std::string::npos) << other.out;
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "project.json"), before);
    answer({"p.qch", "--weights", weights});
    EXPECT_EQ(answer({"p.qch", "--step"})["proposal"], tried["proposal"]);
    EXPECT_EQ(answer({"p.qch", "--accept", "1", "--expect-plane", first})["cuts"].size(), 1U);
    for (const program::Arguments& wrong : {program::Arguments{"segment", "p.qch", "--undo", "--try-weights", weights},
                                            {"segment", "p.qch", "--step", "--expect-plane", first},
                                            {"segment", "p.qch", "--step", "--try-weights", "nonsense=1"}}) {
        EXPECT_EQ(run(wrong).code, 64) << wrong[2];
    }
}

TEST_F(Segment, WritesAPlanThatMakesTheSamePiecesAgain) {
    answer({"p.qch", "--accept", "1"});
    const json cut = answer({"p.qch", "--accept", "2"});
    answer({"p.qch", "--plan", "cuts.plan"});
    const json replayed = answer({"scan.ply", "--units", "mm", "--replay", "cuts.plan", "-o", "again.qch"});
    EXPECT_EQ(replayed["pieces"], cut["pieces"]);
}

TEST_F(Segment, DiscardsByAListAndByVolumeAndUndoesThemTogether) {
    answer({"p.qch", "--accept", "1"});
    const json cut = answer({"p.qch", "--accept", "1"});
    ASSERT_GE(cut["pieces"].size(), 3U);
    std::vector<double> volumes;
    for (const json& piece : cut["pieces"]) volumes.push_back(piece["volume_mm3"]);
    const std::string first = cut["pieces"][0]["name"];
    const std::string last = cut["pieces"].back()["name"];
    const json listed = answer({"p.qch", "--discard", first + "," + last});
    ASSERT_EQ(listed["discarded"].size(), 2U);
    EXPECT_EQ(listed["undo"], "Undo discard of pieces " + first + ", " + last);
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], cut["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--redo"})["discarded"], listed["discarded"]);
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], cut["pieces"]);
    std::sort(volumes.begin(), volumes.end());
    const std::string limit = "below=" + std::to_string((volumes[0] + volumes[1]) / 2) + "mm3";
    const json small = answer({"p.qch", "--discard", limit});
    ASSERT_EQ(small["discarded"].size(), 1U);
    EXPECT_EQ(small["discarded"][0]["volume_mm3"], volumes[0]);
    const json none = answer({"p.qch", "--discard", limit});
    EXPECT_EQ(none["pieces"], small["pieces"]);
    EXPECT_EQ(run({"segment", "p.qch", "--discard", "below=1000l"}).code, 1);
    EXPECT_EQ(run({"segment", "p.qch", "--discard", first + ",nobody"}).code, 64);
    EXPECT_EQ(answer({"p.qch"})["pieces"], small["pieces"]);
}

TEST_F(Segment, DiscardsAPieceAndSaysSoInEveryReport) {
    const json cut = answer({"p.qch", "--accept", "1"});
    const std::string name = cut["pieces"].back()["name"];
    const double gone = cut["pieces"].back()["volume_mm3"];
    const json discarded = answer({"p.qch", "--discard", name});
    ASSERT_EQ(discarded["discarded"].size(), 1U) << discarded.dump(1);
    EXPECT_EQ(discarded["discarded"][0]["name"], name);
    EXPECT_EQ(discarded["discarded"][0]["after"], 1);
    EXPECT_EQ(discarded["discarded"][0]["volume_mm3"], gone);
    EXPECT_NEAR(volume(discarded) + gone, volume(begun), 1e-4 * volume(begun));
    EXPECT_EQ(discarded["undo"], "Undo discard of piece " + name);
    EXPECT_EQ(answer({"p.qch", "--undo"})["pieces"], cut["pieces"]);
    EXPECT_EQ(answer({"p.qch", "--redo"})["pieces"], discarded["pieces"]);
    const std::string line = "discarded after cut 1: piece " + name + ", ";
    const auto says_so = [&](const program::Arguments& arguments) {
        const program::Ended told = run(arguments);
        EXPECT_EQ(told.code, 0) << told.err;
        EXPECT_NE(told.out.find(line), std::string::npos) << arguments[0] << "\n" << told.out;
        program::Arguments as_json = arguments;
        as_json.emplace_back("--json");
        if (arguments[0] == "export") as_json.insert(as_json.end(), {"-o", "again.3mf"});
        const json told_again = json::parse(run(as_json).out, nullptr, false);
        EXPECT_EQ(told_again["discarded"], discarded["discarded"]) << arguments[0];
    };
    says_so({"segment", "p.qch"});
    says_so({"segment", "p.qch", "--plan", "p.plan"});
    says_so({"explain", "p.qch"});
    says_so({"segment", "p.qch", "--auto", "--min-cuts", "1"});
    says_so({"export", "p.qch", "--format", "3mf"});
    EXPECT_NE(program::bytes_in(folder.path / "p.plan").find("[[discard]]"), std::string::npos);
    const json replayed = answer({"scan.ply", "--units", "mm", "--replay", "p.plan", "-o", "again.qch"});
    EXPECT_EQ(replayed["pieces"], discarded["pieces"]);
    EXPECT_EQ(replayed["discarded"], discarded["discarded"]);
    const std::string before = program::bytes_in(folder.path / "again.qch" / "project.json");
    const program::Ended none = run({"segment", "again.qch", "--discard", name});
    EXPECT_EQ(none.code, 64) << none.err;
    ASSERT_EQ(replayed["pieces"].size(), 1U);
    const program::Ended last = run({"segment", "again.qch", "--discard", answer({"again.qch"})["pieces"][0]["name"]});
    EXPECT_EQ(last.code, 1) << last.out;
    EXPECT_NE(last.out.find("No other piece would be left"), std::string::npos) << last.out;
    EXPECT_EQ(before, program::bytes_in(folder.path / "again.qch" / "project.json"));
    answer({"p.qch", "--cell", program::foam_cell()});
    says_so({"prepare", "p.qch"});
}

TEST_F(Segment, TakesItsCellLaterButOnlyOnce) {
    const program::Arguments with_cell{"segment", "p.qch", "--cell", program::foam_cell()};
    EXPECT_EQ(run({"segment", "p.qch", "--auto", "--fits-cell"}).code, 64) << "it has no cell yet";
    program::put(folder.path / "wrong.toml", "nonsense");
    EXPECT_EQ(run({"segment", "p.qch", "--cell", "wrong.toml"}).code, 78);
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "cell.toml"));
    const program::Ended given = run(with_cell);
    EXPECT_EQ(given.code, 0) << given.err;
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "cell.toml"), program::bytes_in(program::foam_cell()));
    EXPECT_EQ(answer({"p.qch", "--auto", "--fits-cell"})["ended_because"], "the stop rules hold");
    const program::Ended again = run(with_cell);
    EXPECT_EQ(again.code, 64);
    EXPECT_NE(again.err.find("has a cell already"), std::string::npos) << again.err;
}

TEST_F(Segment, WritesThePiecesAfterADecisionIfItIsTold) {
    const auto written = [&] {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator(folder.path / "p.qch" / "pieces")) {
            all.push_back(entry.path().stem().string());
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    EXPECT_TRUE(written().empty());
    const json cut = answer({"p.qch", "--accept", "1", "--write-pieces"});
    EXPECT_EQ(written(), names(cut));
    EXPECT_EQ(cut["pieces_written"], "p.qch/pieces");
    EXPECT_EQ(written(), names(answer({"p.qch", "--discard", names(cut)[0], "--write-pieces"})));
    EXPECT_EQ(written(), names(answer({"p.qch", "--undo", "--write-pieces"})));
    answer({"p.qch", "--undo"});
    EXPECT_TRUE(written().empty()) << "they would be of other decisions";
}

TEST_F(Segment, TakesTheVolumeBelowWhichASolidIsAFragment) {
    const json proposal = answer({"p.qch", "--step", "--top", "200"})["proposal"];
    const json all = proposal["planes"];
    const json worst = answer({"p.qch", "--preview", std::to_string(all.size())})["preview"];
    std::vector<double> volumes;
    for (const json& made : worst["makes"]) volumes.push_back(made["volume_mm3"]);
    std::sort(volumes.rbegin(), volumes.rend());
    const std::string limit = std::to_string(volumes[1] * 1.01);  // only the largest would be a piece
    const json limited =
        answer({"scan.ply", "--units", "mm", "--preset", "thesis", "-o", "q.qch", "--fragment-volume", limit});
    EXPECT_EQ(limited["pieces"], begun["pieces"]);
    const json left = answer({"q.qch", "--step", "--top", "200"})["proposal"];
    EXPECT_LT(left["candidates"], proposal["candidates"]);
    for (const json& plane : left["planes"]) EXPECT_NE(plane["offset_mm"], worst["plane"]["offset_mm"]);
    EXPECT_EQ(run({"segment", "q.qch", "--fragment-volume", "1"}).code, 64);
    EXPECT_EQ(run({"prepare", "q.qch", "--fragment-volume", "1", "--cell", program::foam_cell()}).code, 64);
}

TEST_F(Segment, NamesTheCandidateOfEveryPlane) {
    for (const json& plane : answer({"p.qch", "--step", "--top", "200"})["proposal"]["planes"]) {
        EXPECT_TRUE(plane["normal_index"] >= 0 && plane["normal_index"] < 3) << plane.dump();
        EXPECT_TRUE(plane["offset_index"] >= 0 && plane["offset_index"] < 40) << plane.dump();
    }
    EXPECT_EQ(answer({"p.qch", "--plane", "0,0,1,0"})["cuts"][0]["normal_index"], -1);
}

TEST_F(Segment, TakesAPlaneOfAnyFiniteNumbers) {
    const auto made_by = [&](const char* plane) { return answer({"p.qch", "--preview", plane})["preview"]["makes"]; };
    const json one = made_by("0.6,0,0.8,1");
    for (const char* same :
         {"3,0,4,1", "3e300,0,4e300,1", "3e-300,0,4e-300,1", "-3e307,0,-4e307,-1", "+0.6,0,+0.8,+1"}) {
        const json seen = made_by(same);
        ASSERT_EQ(seen.size(), one.size()) << same;
        for (std::size_t i = 0; i < one.size(); ++i) {
            EXPECT_EQ(seen[i]["faces"], one[i]["faces"]) << same;
            EXPECT_NEAR(seen[i]["volume_mm3"].get<double>(), one[i]["volume_mm3"].get<double>(), 1e-9 * volume(begun))
                << same;
        }
    }
    EXPECT_EQ(made_by("0,0,5e-324,0"), made_by("0,0,1,0"));
    for (const char* wrong : {"0,0,0,1", "nan,0,1,0", "inf,0,1,0", "1,0,0,inf", "1,0,0,1e999", "1e-999,0,0,1"}) {
        EXPECT_EQ(run({"segment", "p.qch", "--preview", wrong}).code, 64) << wrong;
    }
}

TEST_F(Segment, TellsAMissFromFragmentsWithTheExtentOfThePiece) {
    for (const char* far : {"0,0,1,1e9", "0,0,1,-1e300", "0,0,1e-200,1.7e308"}) {
        const program::Ended missed = run({"segment", "p.qch", "--plane", far});
        EXPECT_EQ(missed.code, 1) << missed.err;
        EXPECT_NE(missed.out.find("misses piece A, which extends from -"), std::string::npos) << missed.out;
        EXPECT_EQ(missed.out.find("only fragments"), std::string::npos) << missed.out;
    }
    const std::string told = run({"segment", "p.qch", "--plane", "0,0,1,1e9"}).out;
    const std::size_t at = told.find(" to ", told.find("extends from"));
    const double top = std::stod(told.substr(at + 4));
    const program::Ended sliver = run({"segment", "p.qch", "--plane", "0,0,1," + std::to_string(top - 0.002)});
    EXPECT_EQ(sliver.code, 1) << sliver.err;
    EXPECT_NE(sliver.out.find("makes only fragments of piece A"), std::string::npos) << sliver.out;
    EXPECT_NE(sliver.out.find("extends from -"), std::string::npos) << sliver.out;
    EXPECT_EQ(sliver.out.find("misses"), std::string::npos) << sliver.out;
}

// Each command with its own examples, and every format that is read.
TEST(SegmentHelp, AndThatOfEveryOtherCommandShowsItsOwnExamples) {
    const program::Folder folder;
    for (const std::string command : {"sample", "fuse", "inspect", "repair", "prepare", "segment", "explain", "guide",
                                      "export", "dry-run", "cell-sim", "dispatch"}) {
        const program::Ended help = program::run({command, "--help"}, {folder.path});
        EXPECT_EQ(help.code, 0);
        const std::size_t at = help.out.find("Examples:\n");
        ASSERT_NE(at, std::string::npos) << command;
        std::istringstream examples(help.out.substr(at + 10));
        std::size_t count = 0;
        for (std::string line; std::getline(examples, line);) {
            if (line.find("qchopper ") == std::string::npos) continue;
            EXPECT_EQ(line.find("  qchopper " + command + " "), 0U) << line;
            ++count;
        }
        EXPECT_GE(count, 1U) << command;
    }
    for (const char* command : {"inspect", "repair", "prepare", "segment"}) {
        const std::string help = program::run({command, "--help"}, {folder.path}).out;
        for (const char* format : {"PLY", "STL", "OBJ", "OFF", "GLB", "glTF", "3MF", "gzip"}) {
            EXPECT_NE(help.find(format), std::string::npos) << command << " " << format;
        }
    }
}

TEST_F(Segment, KeepsEveryDecisionWhenItIsKilled) {
    program::Process victim({"segment", "p.qch", "--auto", "--min-cuts", "40", "--json"}, {folder.path});
    ASSERT_TRUE(victim.waits_until_err("cut 3 on")) << victim.err();
    victim.signal(SIGKILL);
    EXPECT_EQ(victim.wait().killed_by, SIGKILL);
    const json found = answer({"p.qch"});
    EXPECT_GE(found["cuts"].size(), 3U);
    const double fragments = 1e-5 * found["fragments"].get<double>();  // each at most that share of the scan
    EXPECT_NEAR(volume(found), volume(begun), (1e-9 + fragments) * volume(begun));
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
    const program::Ended nowhere = run({"segment", "none.qch", "--undo"});
    EXPECT_EQ(nowhere.code, 66);
    EXPECT_NE(nowhere.err.find("there is no project none.qch"), std::string::npos) << nowhere.err;
}

}  // namespace
}  // namespace qchopper
