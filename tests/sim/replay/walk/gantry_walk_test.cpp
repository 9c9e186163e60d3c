#include "sim/replay/walk/gantry_walk.h"

#include <gtest/gtest.h>

#include "sim/replay/read_program.h"

namespace qchopper {
namespace {

// Of a cell at whose home the tip is 848 mm above the setup's zero, which lies in the middle of the table.
struct Gantry {
    Cell cell = read_cell(std::string(QCHOPPER_SOURCE_DIR) + "/cells/gantry-3axis.toml");
    ReplayScene scene() const {
        ReplayScene scene;
        scene.cell = &cell;
        scene.orientations.push_back({{0, 0, 1}, 0, {Pose{}.row, {1500, 1000, 10}}});
        scene.chunks.push_back({"qc_1_001", 1, 0});
        scene.block = {{-50, -50, -10}, {50, 50, 50}};
        return scene;
    }
};

const std::string head = "G21\nG90 G17 G94 G40\nG54\n";

std::string with_line_ends(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

struct Walked {
    ToolPath path;
    std::vector<std::string> findings;
};

Walked walked(const std::string& moves, const std::string& tool = "T1 M6\nG43 H1\n",
              const std::string& home = "G0 Z840.00\n", const std::string& chunk_tool = "G43 H1\n") {
    const Gantry gantry;
    const std::string home_xy = "G0 X-1400.00 Y-900.00\n";
    const std::string main =
        head + "(MSG, ASK tool 1 [ball nose 20 mm] is in the spindle, 200.00 mm from the nose to the tip)\nM0\n" +
        tool + home + home_xy + "o<qc_1_001> call\nM5\nG0 Z840.00\n" + home_xy + "M2\n";
    const std::string chunk = "o<qc_1_001> sub\n" + head + chunk_tool +
                              "S15000.0 M3\nG4 P5.0\nG0 Z840.00\nG0 X0.00 Y0.00\n" + moves +
                              "G0 Z840.00\no<qc_1_001> endsub\n";
    const std::vector<ProgramFile> files{{"qc_1.ngc", with_line_ends(main)}, {"qc_1_001.ngc", with_line_ends(chunk)}};
    FindingLog log;
    const ReplayScene scene = gantry.scene();
    Walked result{walk_gantry(read_program(Dialect::ngc, files, "qc_1", gantry.cell), scene, log, {}), {}};
    for (const Finding& finding : log.findings()) result.findings.push_back(finding.text);
    return result;
}

const std::string corner =
    "G64 P0.100\nG1 X0.00 Y0.00 Z60.00 F6000.0\nG1 X10.00 Y0.00 Z60.00\nG61\nG1 X10.00 Y10.00 Z60.00\n";

TEST(GantryWalk, ADeviationIsADistanceFromTheCorner) {
    const Walked good = walked(corner);
    EXPECT_TRUE(good.findings.empty()) << good.findings.front();
    ASSERT_EQ(good.path.lines.size(), 3U);
    // At 90 degrees a corner that begins a before its point is a cos(45 degrees) / 2 off it.
    EXPECT_NEAR(good.path.lines[1].rounding, 2 * 0.1 / std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(corner_of(good.path.lines[1], good.path.lines[2]).deviation, 0.1, 1e-9);
    EXPECT_EQ(good.path.lines[2].rounding, 0);
    EXPECT_EQ(good.path.lines[1].feed, 100);
    EXPECT_TRUE(good.path.lines[1].signals.spindle_is_on && good.path.lines[1].signals.has_speed);
}

TEST(GantryWalk, ARapidIsLookedAtAsADogLegToo) {
    const ToolPath path = walked(corner).path;
    double farthest = 0;  // from the line between its ends
    for (const JointSweep& sweep : path.sweeps) {
        for (const TipPose& pose : sweep.poses) {
            if (pose.tip.z > 839)
                farthest = std::max(farthest, std::abs(9 * pose.tip.x - 14 * pose.tip.y) / std::hypot(9, 14));
        }
    }
    // 900 mm along both axes, then 500 mm along X.
    EXPECT_NEAR(farthest, 900 * 5 / std::hypot(9, 14), 1);
}

TEST(GantryWalk, FindsWrongToolsAndPlaces) {
    const auto all = [](const Walked& walked) {
        std::string texts;
        for (const std::string& text : walked.findings) texts += text + "\n";
        return texts;
    };
    EXPECT_NE(all(walked(corner, "T2 M6\nG43 H2\n")).find("T2 is in the spindle"), std::string::npos);
    EXPECT_NE(all(walked(corner, "T99 M6\nG43 H99\n")).find("no tool of the cell file"), std::string::npos);
    EXPECT_NE(all(walked(corner, "T1 M6\nG43 H1\n", "G0 Z840.00\n", "G43 H2\n")).find("length of H2"),
              std::string::npos);
    EXPECT_NE(all(walked(corner, "T1 M6\nG43 H1\n", "G0 Z100.00\n")).find("does not lead home"), std::string::npos);
    EXPECT_NE(all(walked("G61\n"
                         "G1 X0.00 Y1500.00 Z60.00 F6000.0\n"))
                  .find("beyond the travel"),
              std::string::npos);
}

}  // namespace
}  // namespace qchopper
