// cells as a process: what it lists, shows and checks, and its exit codes.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Cells : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    void SetUp() override {
        fs::copy(fs::path(QCHOPPER_SOURCE_DIR) / "cells", folder.path / "cells");
        before = program::contents(folder.path);
    }
    void TearDown() override { EXPECT_EQ(program::difference(before, program::contents(folder.path)), ""); }
    program::Contents before;
};

TEST_F(Cells, ListsTheFolder) {
    const program::Ended listed = run({"cells", "list"});
    EXPECT_EQ(listed.code, 0) << listed.err;
    for (const char* text : {"cells/foam-1.toml", "KUKA KR 120 R2500 pro", "gantry of three axes"}) {
        EXPECT_NE(listed.out.find(text), std::string::npos) << listed.out;
    }
    const json rows = json::parse(run({"cells", "list", "cells", "--json"}).out);
    EXPECT_EQ(rows["schema"], "qchopper-cells-1");
    ASSERT_EQ(rows["cells"].size(), 5U);
    EXPECT_EQ(rows["cells"][0]["robot"], nullptr);
    EXPECT_EQ(rows["cells"][4]["robot"], "KUKA KR 60 HA");
    EXPECT_EQ(rows["cells"][4]["may_be_dispatched"], false);
}

TEST_F(Cells, AWrongFileDoesNotHideTheOthers) {
    program::put(folder.path / "cells" / "wrong.toml", "version = 2\nnam = \"x\"\n");
    before = program::contents(folder.path);
    const program::Ended listed = run({"cells", "list", "--json"});
    EXPECT_EQ(listed.code, 78) << listed.err;
    const json rows = json::parse(listed.out)["cells"];
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[5]["error"], "cells/wrong.toml:2: unknown key nam");
    EXPECT_EQ(run({"cells", "list", "nowhere"}).code, 66);
    EXPECT_EQ(run({"cells", "show", "cells/wrong.toml"}).code, 78);
    EXPECT_EQ(run({"cells", "check", "cells/none.toml"}).code, 66);
    EXPECT_EQ(run({"cells"}).code, 64);
    EXPECT_EQ(run({"cells", "shw"}).code, 64);
}

TEST_F(Cells, ShowsWhatTheFileDescribes) {
    const program::Ended shown = run({"cells", "show", "cells/kr120-r2500-pro-rotary.toml"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    for (const char* text : {"robot      KUKA KR 120 R2500 pro, payload 120 kg", "\n4     -350     350      292    584",
                             "rotary, radius 750", "ball nose 6 mm", "kerf 3"}) {
        EXPECT_NE(shown.out.find(text), std::string::npos) << text << "\n" << shown.out;
    }
    const json robot = json::parse(run({"cells", "show", "cells/irb6640-185-2.8.toml", "--json"}).out);
    EXPECT_EQ(robot["schema"], "qchopper-cell-2");
    EXPECT_EQ(robot["machine"]["robot"]["lengths"]["c3"], 1392);
    EXPECT_NEAR(robot["machine"]["robot"]["axes"][1]["max_deg"].get<double>(), 85.1, 1e-9);
    EXPECT_EQ(robot["machine"]["tools"][0]["gauge_length"], 200);
    const program::Ended old = run({"cells", "show", "cells/foam-1.toml"});
    EXPECT_NE(old.out.find("not described: the arm is not checked"), std::string::npos) << old.out;
    EXPECT_TRUE(json::parse(run({"cells", "show", "cells/foam-1.toml", "--json"}).out)["machine"].is_null());
}

TEST_F(Cells, TellsWhereABlockCanStand) {
    const program::Ended shown =
        run({"cells", "reach", "cells/irb6640-185-2.8.toml", "--tilt", "30", "--block", "400,400,300"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    for (const char* text :
         {"block of 400 x 400 x 300 mm", "tilt of 30 degrees from all around", "y \\ x", "\n-200 ", "Best place: x "}) {
        EXPECT_NE(shown.out.find(text), std::string::npos) << text << "\n" << shown.out;
    }
    const json map = json::parse(run({"cells", "reach", "cells/irb6640-185-2.8.toml", "--tilt", "30", "--json"}).out);
    EXPECT_EQ(map["schema"], "qchopper-cell-reach-2");
    EXPECT_NEAR(map["tilt_deg"].get<double>(), 30, 1e-9);
    EXPECT_EQ(map["best"]["arm_checked"], true);
    EXPECT_TRUE(map["best"]["margins"].contains("joint_limit"));
    EXPECT_GT(map["places"].size(), 10U);
}

TEST_F(Cells, SaysWhereNoBlockCanStand) {
    const program::Ended none = run({"cells", "reach", "cells/gantry-3axis.toml", "--tilt", "30"});
    EXPECT_EQ(none.code, 1) << none.err;
    EXPECT_NE(none.out.find("No place holds. The best is x "), std::string::npos) << none.out;
    EXPECT_NE(none.out.find("; travel, "), std::string::npos) << none.out;
    const program::Ended old = run({"cells", "reach", "cells/foam-1.toml", "--tilt", "0"});
    EXPECT_EQ(old.code, 64);
    EXPECT_NE(old.err.find("describes no machine"), std::string::npos) << old.err;
    EXPECT_EQ(run({"cells", "reach", "cells/kr60-ha.toml"}).code, 64) << "no tilt";
    const program::Ended unknown = run({"cells", "show", "kr60-hb"});
    EXPECT_EQ(unknown.code, 66);
    EXPECT_NE(unknown.err.find("there is no cell file kr60-hb, and no ready cell of that name"), std::string::npos)
        << unknown.err;
    EXPECT_EQ(run({"cells", "reach", "cells/kr60-ha.toml", "--tilt", "91"}).code, 64);
    EXPECT_EQ(run({"cells", "reach", "cells/kr60-ha.toml", "--tilt", "0", "--block", "1,2"}).code, 64);
}

TEST_F(Cells, DrawsTheReach) {
    const std::string png = "\x89PNG\r\n\x1a\n";
    program::put(folder.path / "reach.png", "an older file");
    const program::Ended shown = run({"cells", "show", "cells/kr60-ha.toml", "-o", "reach.png"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_NE(shown.out.find("picture    reach.png, section x-z at y = 0: reach"), std::string::npos) << shown.out;
    const std::string bytes = program::bytes_in(folder.path / "reach.png");
    EXPECT_EQ(bytes.substr(0, 8), png);
    EXPECT_GT(bytes.size(), 10'000U);
    const program::Arguments to_other{"cells", "show", "cells/kr60-ha.toml", "-o", "other.png", "--json"};
    const json document = json::parse(run(to_other).out);
    EXPECT_EQ(document["picture"], "other.png");
    EXPECT_EQ(program::bytes_in(folder.path / "other.png"), bytes);
    const json without = json::parse(run({"cells", "show", "cells/kr60-ha.toml", "--json"}).out);
    EXPECT_FALSE(without.contains("picture"));
    for (const char* name : {"foam-1", "gantry-3axis"}) {
        const std::string file = std::string(name) + ".png";
        const program::Ended drawn = run({"cells", "show", "cells/" + std::string(name) + ".toml", "-o", file});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        const char* words = name[0] == 'f' ? "because no robot is described" : "and nothing at a tilt";
        EXPECT_NE(drawn.out.find(words), std::string::npos) << drawn.out;
        EXPECT_EQ(program::bytes_in(folder.path / file).substr(0, 8), png);
        fs::remove(folder.path / file);
    }
    fs::remove(folder.path / "reach.png");
    fs::remove(folder.path / "other.png");
    EXPECT_EQ(run({"cells", "show", "cells/kr60-ha.toml", "-o", "reach.svg"}).code, 64);
    EXPECT_EQ(run({"cells", "show", "cells/kr60-ha.toml", "-o", "nowhere/reach.png"}).code, 73);
    EXPECT_EQ(run({"cells", "show", "cells/none.toml", "-o", "reach.png"}).code, 66);
}

TEST_F(Cells, ChecksWhatIsAssumed) {
    const program::Ended checked = run({"cells", "check", "cells/kr60-ha.toml"});
    EXPECT_EQ(checked.code, 1) << checked.err;
    EXPECT_NE(checked.out.find("robot.base.position is assumed: a frame"), std::string::npos) << checked.out;
    EXPECT_NE(checked.out.find("dispatch: not allowed"), std::string::npos) << checked.out;
    const json document = json::parse(run({"cells", "check", "cells/kr60-ha.toml", "--json"}).out);
    EXPECT_EQ(document["schema"], "qchopper-cell-check-1");
    EXPECT_EQ(document["may_be_dispatched"], false);
    EXPECT_EQ(document["uncertain"][0],
              (json{{"table", "robot"}, {"key", "acceleration_deg_per_s2"}, {"origin", "assumed"}}));
    EXPECT_EQ(run({"cells", "check", "cells/foam-1.toml"}).code, 1);
}

TEST_F(Cells, MakesAFileForARobot) {
    const program::Ended made = run({"cells", "new", "--robot", "KR 210 R2700", "-o", "mine.toml", "--json"});
    ASSERT_EQ(made.code, 0) << made.err;
    const json document = json::parse(made.out);
    EXPECT_EQ(document["schema"], "qchopper-new-cell-1");
    EXPECT_EQ(document["arm"]["robot"], "kr210-r2700");
    ASSERT_EQ(document["poses"].size(), 5U);
    const std::string drawing = program::bytes_in(folder.path / "mine.svg");
    EXPECT_EQ(drawing.substr(0, 5), "<svg ");
    for (const char* length :
         {"a1 = 350<", "a2 = 41<", "b = 0,", "c1 = 675<", "c2 = 1150<", "c3 = 1200<", "c4 = 215<"}) {
        EXPECT_NE(drawing.find(length), std::string::npos) << length;
    }
    const program::Ended shown = run({"cells", "show", "mine.toml", "--drawing", "again.svg", "--json"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_EQ(program::bytes_in(folder.path / "again.svg"), drawing);
    EXPECT_EQ(json::parse(shown.out)["machine"]["robot"]["display_poses"], document["poses"]);
    const program::Ended again = run({"cells", "new", "--robot", "kr60-ha", "-o", "mine.toml"});
    EXPECT_EQ(again.code, 73) << again.err;
    EXPECT_NE(again.err.find("mine.toml is there already"), std::string::npos) << again.err;
    for (const char* file : {"mine.toml", "mine.svg", "again.svg"}) fs::remove(folder.path / file);
    const program::Ended plain = run({"cells", "new", "--robot", "m710ic-50"});
    EXPECT_EQ(plain.code, 0) << plain.err;
    EXPECT_NE(plain.out.find("J3 + J2 of the pendant"), std::string::npos) << plain.out;
    for (const char* file : {"m710ic-50.toml", "m710ic-50.svg"}) EXPECT_TRUE(fs::remove(folder.path / file));
}

TEST_F(Cells, ListsTheRobotsAndRefusesWhatItCannotMove) {
    const json robots = json::parse(run({"cells", "robots", "--json"}).out)["robots"];
    EXPECT_GE(robots.size(), 25U);
    EXPECT_NE(run({"cells", "robots"}).out.find("kr120r2500pro_macro.xacro"), std::string::npos);
    const program::Ended parallel = run({"cells", "new", "--robot", "ur10e"});
    EXPECT_EQ(parallel.code, 64);
    EXPECT_NE(parallel.err.find("three of its axes are parallel"), std::string::npos) << parallel.err;
    const program::Ended misspelt = run({"cells", "new", "--robot", "kr120-r2500"});
    EXPECT_EQ(misspelt.code, 64);
    EXPECT_NE(misspelt.err.find("kr120-r2500-pro"), std::string::npos) << misspelt.err;
    EXPECT_EQ(run({"cells", "new", "--robot", "kr60-ha", "-o", "cell.txt"}).code, 64);
    EXPECT_EQ(run({"cells", "new", "--robot", "kr60-ha", "--id", "0"}).code, 64);
    EXPECT_EQ(run({"cells", "new", "--robot", "kr60-ha", "--name", "a \"quoted\" name"}).code, 64);
    EXPECT_EQ(run({"cells", "new", "--robot", "kr60-ha", "-o", "nowhere/cell.toml"}).code, 73);
}

// "J1,...,J6=X,Y,Z,A,B,C" of a pose that the program itself shows.
std::string pose_option(const json& pose) {
    std::string text;
    for (const json& joint : pose["joints_deg"]) text += (text.empty() ? "" : ",") + joint.dump();
    text += "=";
    for (const json& length : pose["position"]) text += length.dump() + ",";
    return text + pose["abc_deg"][0].dump() + "," + pose["abc_deg"][1].dump() + "," + pose["abc_deg"][2].dump();
}

TEST_F(Cells, TaughtPosesTellWhichValueIsWrong) {
    const std::string file = "cells/kr60-ha.toml";
    const json poses = json::parse(run({"cells", "show", file, "--json"}).out)["machine"]["robot"]["display_poses"];
    const program::Arguments check{"cells",  "check",
                                   file,     "--json",
                                   "--pose", pose_option(poses[2]),
                                   "--pose", pose_option(poses[3]),
                                   "--pose", pose_option(poses[4])};
    const json right = json::parse(run(check).out)["taught_poses"];
    EXPECT_EQ(right["agrees"], true);
    const std::string bytes = program::bytes_in(folder.path / file);
    for (const auto& [from, to, sentence] :
         {std::tuple{"sign = [-1, 1,", "sign = [-1, -1,", "sign of axis 2 is -1 and should be 1"},
          std::tuple{"[0.0, -90.0,", "[0.0, -1.570796,", "it stands in radians"},
          std::tuple{"a2 = -145.0", "a2 = 145.0", "a2 is 145 and should be -145: its sign is wrong"},
          std::tuple{"c2 = 850.0", "c2 = 0.85", "c2 is 0.85 and should be 850: it stands in metres"}}) {
        std::string wrong = bytes;
        wrong.replace(wrong.find(from), std::string(from).size(), to);
        program::put(folder.path / file, wrong);
        program::Arguments as_text = check;
        std::erase(as_text, "--json");
        const program::Ended told = run(as_text);
        EXPECT_EQ(told.code, 1) << told.err;
        EXPECT_NE(told.out.find(sentence), std::string::npos) << sentence << "\n" << told.out;
    }
    program::put(folder.path / file, bytes);
    EXPECT_EQ(run({"cells", "check", file, "--pose", pose_option(poses[0])}).code, 64);
    EXPECT_EQ(run({"cells", "check", file, "--pose", "1,2,3=4,5,6"}).code, 64);
    EXPECT_EQ(run({"cells", "check", "cells/gantry-3axis.toml", "--pose", pose_option(poses[0]), "--pose",
                   pose_option(poses[1])})
                  .code,
              64);
}

}  // namespace
}  // namespace qchopper
