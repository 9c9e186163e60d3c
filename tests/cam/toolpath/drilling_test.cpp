// Holes of small pieces: where the drill goes, and every reason why it does not.

#include "cam/toolpath/drilling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cam/toolpath/make_toolpath.h"
#include "tests/cam/toolpath/plain_replay.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::setup_of;

struct Milled {
    TriangleMesh mesh;  // in setup coordinates
    Setup setup;
    Cell cell;
    Toolpath toolpath;
    std::optional<InProcessStock> left;
};

// `mesh` is not moved by the setup but for its middle.
std::unique_ptr<Milled> milled(const TriangleMesh& mesh) {
    auto made = std::make_unique<Milled>();
    made->setup = setup_of(mesh, 5);
    made->mesh = mesh;
    for (Vec3& p : made->mesh.points) p = apply(made->setup.piece_in_setup, p);
    made->cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    ToolpathSettings settings;
    settings.cell = 0.5;
    settings.finishing_tools = {2};  // the ball of 12 mm
    made->left.emplace(made->setup);
    made->toolpath = make_toolpath(made->setup, mesh, made->cell, settings, {}, &*made->left);
    return made;
}

// A box of 60 mm by 40 mm, 50 mm tall.
const Milled& box() {
    static const std::unique_ptr<Milled> made = milled(shapes::box({-30, -20, 0}, {30, 20, 50}));
    return *made;
}

Drilling drilled(const Milled& on, const DrillHole& hole) {
    return drill_holes({&hole, 1}, on.setup, on.mesh, on.cell, *on.left);
}

TEST(Drilling, GoesDownInPecksUntilTheFullDiameterIsAsDeepAsTheHole) {
    const DrillHole hole{3, {5, -4, 50}, {0, 0, 1}, 8, 22, 6, {}};
    const Drilling drilling = drilled(box(), hole);
    EXPECT_TRUE(drilling.orientations.empty()) << "straight from above is a direction of the setup";
    ASSERT_EQ(drilling.operations.size(), 1U);
    const Operation& operation = drilling.operations.front();
    const CuttingTool& tool = box().cell.machine->tools[operation.tool];
    EXPECT_EQ(operation.kind, OperationKind::drilling);
    EXPECT_TRUE(is_drill(tool));
    EXPECT_EQ(tool.diameter, 8);
    ASSERT_EQ(operation.runs.size(), 1U);
    const PathRun& run = operation.runs.front();
    EXPECT_EQ(run.hole, 3U);
    double deepest = 0;
    double before = 50;
    for (const PathMove& move : run.moves) {
        EXPECT_EQ(move.tip.x, 5);
        EXPECT_EQ(move.tip.y, -4);
        deepest = std::min(deepest, move.tip.z - 50);
        EXPECT_TRUE(move.kind != MoveKind::link || move.tip.z > 51);
        EXPECT_LE(before - move.tip.z, 2 * 8 + 6) << "a peck of two diameters";
        before = std::min(before, move.tip.z);
    }
    EXPECT_NEAR(deepest, -22 - point_height(tool), 1e-9);
    EXPECT_EQ(run.moves.back().tip, run.start);
    EXPECT_EQ(run.start.z, retract_height(box().setup, {0, 0, 1}, box().cell.clearance));
}

TEST(Drilling, InAWholeBlockTakesTheHoleAndTheFoamOverIt) {
    const DrillHole hole{1, {5, -4, 50}, {0, 0, 1}, 8, 22, 6, {}};
    test_pieces::PlainReplay replay(box().setup, box().cell, 1);
    const auto count = [&] {
        std::size_t in = 0;
        for (std::size_t i = 0; i < replay.points().size(); ++i) in += replay.is_stock(i) ? 1 : 0;
        return in;
    };
    const std::size_t before = count();
    const InProcessStock whole(box().setup);
    const Drilling drilling = drill_holes({&hole, 1}, box().setup, box().mesh, box().cell, whole);
    ASSERT_EQ(drilling.operations.size(), 1U) << drilling.holes.front().by_hand;
    replay.mill(drilling.operations.front());
    EXPECT_EQ(replay.faults().link_in_stock, 0U) << replay.faults().first;
    EXPECT_EQ(replay.faults().above_flute, 0U) << replay.faults().first;
    EXPECT_EQ(replay.faults().holder, 0U) << replay.faults().first;
    const double volume = 3.14159265 * 16 * (5 + 22 + 2.4034 / 3);
    EXPECT_NEAR(static_cast<double>(before - count()), volume, 0.06 * volume);  // points of 1 mm3
}

TEST(Drilling, EveryReasonForTheHandIsSaid) {
    const DrillHole good{1, {5, -4, 50}, {0, 0, 1}, 8, 22, 6, {}};
    const auto reason = [&](const DrillHole& hole) {
        const Drilling drilling = drilled(box(), hole);
        EXPECT_EQ(drilling.operations.empty(), !drilling.holes.front().by_hand.empty());
        return drilling.holes.front().by_hand;
    };
    EXPECT_EQ(reason(good), "");
    DrillHole hole = good;
    hole.diameter = 7;
    EXPECT_EQ(reason(hole), "the cell has no drill of 7.0 mm");
    hole = good;
    hole.wall = 2;
    EXPECT_NE(reason(hole).find("the point of drill 5 goes 2.4 mm below the hole"), std::string::npos);
    hole = good;
    hole.depth = 79;
    EXPECT_NE(reason(hole).find("the flute of drill 5 is 80 mm long"), std::string::npos);
    hole = good;
    hole.mouth = {5, -4, 10};  // 40 mm of foam that nobody removes stand over it
    EXPECT_NE(reason(hole), "");
    hole = good;
    hole.by_hand = "its cap is the base";
    EXPECT_EQ(reason(hole), "its cap is the base");
}

TEST(Drilling, HolesUnderThePieceOrBesideAWallAreForTheHand) {
    TriangleMesh table = shapes::box({-40, -30, 0}, {40, 30, 20});
    const TriangleMesh plate = shapes::box({-40, -30, 40}, {0, 30, 50});
    const auto first = static_cast<std::uint32_t>(table.points.size());
    table.points.insert(table.points.end(), plate.points.begin(), plate.points.end());
    for (const auto& t : plate.triangles) table.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const std::unique_ptr<Milled> on = milled(table);
    EXPECT_EQ(drilled(*on, {1, {-20, 0, 20}, {0, 0, 1}, 4, 12, 2, {}}).holes.front().by_hand,
              "the piece stands over it");
    EXPECT_EQ(drilled(*on, {1, {-1, 0, 20}, {0, 0, 1}, 4, 12, 2, {}}).holes.front().by_hand,
              "the piece stands over it");
    EXPECT_EQ(drilled(*on, {1, {25, 0, 20}, {0, 0, 1}, 4, 12, 2, {}}).holes.front().by_hand, "");
    const std::unique_ptr<Milled> pit = milled(shapes::box({-30, -20, 0}, {30, 20, 50}));
    CuttingTool& drill = pit->cell.machine->tools[4];
    drill.stick_out = 25;  // the holder comes to 0.6 mm over the cap
    drill.flute_length = 25;
    const std::string why = drilled(*pit, {1, {5, -4, 50}, {0, 0, 1}, 8, 22, 6, {}}).holes.front().by_hand;
    EXPECT_NE(why.find("drill 5"), std::string::npos) << why;
}

TEST(Drilling, HolesOfOneToolAndDirectionAreOneOperation) {
    const Vec3 leant = normalized({0.5, 0, 1});
    const std::vector<DrillHole> holes{{1, {5, -4, 50}, {0, 0, 1}, 8, 22, 6, {}},
                                       {2, {-12, 4, 50}, {0, 0, 1}, 6, 16, 3, {}},
                                       {3, {-5, 10, 50}, {0, 0, 1}, 8, 22, 6, {}},
                                       {4, {20, 0, 53}, leant, 8, 22, 6, {}}};
    const Drilling drilling = drill_holes(holes, box().setup, box().mesh, box().cell, *box().left);
    std::vector<std::vector<std::size_t>> numbers;
    for (const Operation& operation : drilling.operations) {
        numbers.emplace_back();
        for (const PathRun& run : operation.runs) numbers.back().push_back(run.hole);
    }
    EXPECT_EQ(numbers, (std::vector<std::vector<std::size_t>>{{1, 3}, {4}, {2}}));
    ASSERT_EQ(drilling.orientations.size(), 1U);
    EXPECT_EQ(drilling.orientations.front().tool_axis, leant);
    EXPECT_EQ(drilling.operations[1].orientation, 1U);
}

}  // namespace
}  // namespace qchopper
