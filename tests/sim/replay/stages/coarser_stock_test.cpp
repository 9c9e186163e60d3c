#include "sim/replay/stages/coarser_stock.h"

#include <gtest/gtest.h>

#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/stock_model.h"

namespace qchopper {
namespace {

const Box block{{-50.3, -30, 0}, {50, 30.7, 30}};
const std::vector<Vec3> tool_axes{{0, 0, 1}, {0, 0.6, 0.8}};
const Cutter ball{ToolShape::ball, 6, 6, 0, 1};

StockRecord some_stock() {
    StockModel stock_model(block, tool_axes, 0.25);
    stock_model.cut(0, ball, 100, {-60, -5, 12.3}, {60, 3, 17.8});
    stock_model.cut(1, ball, 100, {-60, 20, 20.1}, {60, 10, 18.7});
    StockRecord stock = stock_model.record();
    stock.tools = {{1, 0}};
    return stock;
}

// Whether one of the points about it is foam and it is not, or the other way round.
bool is_near_surface(const StockModel& stock_model, Vec3 point, double distance) {
    for (const double share : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        for (int i = 0; i < 27; ++i) {
            const int row = i / 3 % 3;
            const int layer = i / 9;
            const Vec3 off{static_cast<double>(i % 3 - 1), static_cast<double>(row - 1),
                           static_cast<double>(layer - 1)};
            const Vec3 there = point + share * distance * off;
            if (stock_model.is_in_stock(there) != stock_model.is_in_stock(point)) return true;
        }
    }
    return false;
}

TEST(CoarserStock, DiffersAtTheSurfaceAlone) {
    const StockRecord stock = some_stock();
    StockModel fine(block, tool_axes, stock.cell);
    fine.start_from(stock);
    for (const double cell : {0.5, 0.75, 1.0}) {
        const StockRecord larger = coarser(stock, cell);
        EXPECT_EQ(larger.cell, cell);
        EXPECT_EQ(larger.tools, stock.tools);
        StockModel coarse(block, tool_axes, cell);
        coarse.start_from(larger);
        std::size_t differ = 0;
        std::size_t all = 0;
        for (double x = -49.9; x < 50; x += 0.7) {
            for (double y = -29.9; y < 30; y += 0.7) {
                for (double z = 0.2; z < 30; z += 1.1) {
                    ++all;
                    const bool is_in = fine.is_in_stock({x, y, z});
                    if (is_in == coarse.is_in_stock({x, y, z})) continue;
                    ++differ;
                    EXPECT_TRUE(is_near_surface(fine, {x, y, z}, 1.5 * cell))
                        << x << " " << y << " " << z << ": " << cell;
                }
            }
        }
        EXPECT_LT(differ, all / 50) << cell;
    }
}

TEST(CoarserStock, TheSameCellsKeepWhatTheyAre) {
    const StockRecord stock = some_stock();
    const StockRecord same = coarser(stock, stock.cell);
    ASSERT_EQ(same.maps.size(), stock.maps.size());
    for (std::size_t d = 0; d < stock.maps.size(); ++d) {
        ASSERT_LE(same.maps[d].tiles.size(), stock.maps[d].tiles.size());
        for (std::size_t t = 0; t < same.maps[d].tiles.size(); ++t) {
            for (std::size_t c = 0; c < same.maps[d].tiles[t].height.size(); ++c) {
                ASSERT_GE(same.maps[d].tiles[t].height[c], stock.maps[d].tiles[t].height[c]) << "stock is not less";
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
