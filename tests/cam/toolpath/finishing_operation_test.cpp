// What one operation finishes: its maps in tiles, its passes, and surface that is given back.

#include "cam/toolpath/finishing_operation.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

using test_pieces::bumpy;
using test_pieces::setup_of;

constexpr std::size_t ball_20 = 0;  // of the cell
constexpr double foam_cell = 2;

// A low piece with bumps, over which no holder comes near to foam.
struct SomeOperation {
    TriangleMesh mesh = bumpy(60, 16, 12, 4);
    Setup setup = setup_of(mesh, 8);
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    ToolpathSettings settings;
    HeightField piece = piece_height_field(setup, mesh, 0, {foam_cell, 0, 30});
    RestMaterial rest{mesh, setup};

    SomeOperation() { settings.cell = 0.5; }

    FinishingInput input(const HeightField* stock = nullptr) const {
        return {setup, mesh, *cell.machine, settings, piece, 30, stock};
    }
    PassesLeft make(OperationKind kind, const HeightField* stock = nullptr) {
        return finishing_operation(operation_of(*cell.machine, ball_20, kind, 0), input(stock), rest, {});
    }
    HeightField stock_over_piece(float high) const {
        HeightField stock = piece;
        for (float& z : stock.height) z += high;
        return stock;
    }
};

TEST(FinishingOperation, HasTheCLSurfaceOfTheToolInItsTilesAndItsPassesThere) {
    SomeOperation some;
    const PassesLeft left = some.make(OperationKind::fine_finishing);
    const HeightField whole = cl_surface(left.over_piece->piece, some.cell.machine->tools[ball_20], {0, 0.075});
    std::size_t in_tiles = 0;
    for (std::size_t i = 0; i < whole.height.size(); ++i) {
        if (!left.tiles.tip.holds(i)) continue;
        ASSERT_EQ(left.cl.height[i], whole.height[i]);
        ++in_tiles;
    }
    EXPECT_GT(in_tiles, 10000U);
    EXPECT_LT(in_tiles, whole.height.size());
    ASSERT_GT(left.passes.size(), 10U);
    for (const Pass& pass : left.passes) {
        for (const PassPoint& point : pass.points) {
            const auto column = static_cast<std::size_t>(point.tip.x / whole.cell);
            const auto row = static_cast<std::size_t>(point.tip.y / whole.cell);
            ASSERT_TRUE(left.tiles.tip.holds(row * whole.columns + column));
        }
    }
}

TEST(FinishingOperation, ASecondTimeNoSurfaceIsLeftAndPassesGoAlongTheFloorAlone) {
    SomeOperation some;
    EXPECT_TRUE(some.make(OperationKind::finishing).has_surface);
    const PassesLeft floor = some.make(OperationKind::finishing);
    EXPECT_FALSE(floor.has_surface);
    EXPECT_FALSE(floor.passes.empty());
    const PassesLeft none = some.make(OperationKind::fine_finishing);
    EXPECT_FALSE(none.has_surface);
    EXPECT_TRUE(none.passes.empty());
}

TEST(FinishingOperation, GoesNoDeeperThanStandingFoamLetsIt) {
    SomeOperation some;
    const HeightField high = some.stock_over_piece(400);
    const PassesLeft none = some.make(OperationKind::finishing, &high);
    EXPECT_FALSE(none.has_surface);
    EXPECT_TRUE(none.passes.empty());
    const HeightField low = some.stock_over_piece(5);
    EXPECT_FALSE(some.make(OperationKind::finishing, &low).passes.empty());
}

TEST(FinishingOperation, SurfaceThatIsGivenBackIsLeftToTheNext) {
    SomeOperation some;
    PassesLeft first = some.make(OperationKind::finishing);
    const HeightField low = some.stock_over_piece(5);
    PassesLeft again = some.make(OperationKind::finishing);
    EXPECT_FALSE(give_back(again, some.input(&low), some.rest)) << "it had none";
    const HeightField high = some.stock_over_piece(400);
    EXPECT_TRUE(give_back(first, some.input(&high), some.rest));
    EXPECT_EQ(first.take, 0U);
    EXPECT_FALSE(give_back(first, some.input(&high), some.rest)) << "once only";
    EXPECT_TRUE(some.make(OperationKind::finishing).has_surface);
}

}  // namespace
}  // namespace qchopper
