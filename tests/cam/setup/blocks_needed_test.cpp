#include "cam/setup/blocks_needed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cam/setup/block.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/stock_fit.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

std::vector<Cell> cells() {
    std::vector<Cell> all{cell()};
    for (const char* name : {"foam-1", "gantry-3axis", "irb6640-185-2.8", "kr120-r2500-pro-rotary", "kr60-ha"}) {
        all.push_back(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (std::string(name) + ".toml")));
    }
    return all;
}

// A piece that lies as it is and its block, whose conditions on the cell are checked as everywhere else.
bool stands(Vec3 block, const Cell& cell) {
    qchopper::Setup setup;
    setup.block.size = block;
    setup.box = {{0, 0, 0}, {0, 0, 0}};
    const std::vector<Margin> margins = check_stock_fit(setup, cell).margins;
    for (std::size_t m = 3; m < margins.size(); ++m) {
        if (margins[m].mm < -1e-6) return false;
    }
    return true;
}

TEST(BlocksNeeded, TheLargestBlockStandsInTheCellAndNoLargerOne) {
    for (const Cell& in : cells()) {
        const Vec3 most = largest_block(in);
        EXPECT_TRUE(stands(most, in)) << in.name;
        EXPECT_FALSE(stands(most + Vec3{0.01, 0, 0}, in)) << in.name;
        EXPECT_FALSE(stands(most + Vec3{0, 0.01, 0}, in)) << in.name;
        EXPECT_FALSE(stands(most + Vec3{0, 0, 0.01}, in)) << in.name;
    }
    Cell low = cell();
    low.table.height = low.workspace.min.z - 1;
    EXPECT_LE(largest_block(low).z, 0);
    EXPECT_TRUE(std::isinf(blocks_needed(usable_blocks(low), {1, 1, 1})));
}

// Boxes that stand as they are and lie on one cap, so that nothing but their size decides.
TEST(BlocksNeeded, ABoxOfTheUsableSizeFitsTheCellAndALargerOneNeedsTwo) {
    for (const Cell& in : cells()) {
        const std::vector<Vec3> usable = usable_blocks(in);
        ASSERT_FALSE(usable.empty()) << in.name;
        for (const Vec3 size : usable) {
            EXPECT_EQ(blocks_needed(usable, size), 1);
            EXPECT_EQ(blocks_needed(usable, {size.z, size.x, size.y}), 1);
            EXPECT_TRUE(fits_cell(standing_box({0, 0, 0}, size, 0), in))
                << in.name << ": " << size.x << " " << size.y << " " << size.z;
            const double longest = std::max({size.x, size.y, size.z});
            double most = 0;
            for (const Vec3 other : usable) most = std::max({most, other.x, other.y, other.z});
            if (longest < most) continue;
            EXPECT_EQ(blocks_needed(usable, {longest + 0.1, 1, 1}), 2);
            EXPECT_FALSE(fits_cell(standing_box({0, 0, 0}, {longest + 2, 10, 10}, 0), in)) << in.name;
        }
    }
}

TEST(BlocksNeeded, ASawnBlockServesInEveryOrderThatTheCellHolds) {
    const Cell kr60 = cells().back();
    const std::vector<Vec3> usable = usable_blocks(kr60);
    // "long", 600 x 900 x 500: sides 5, top 3, spoil layer 12 under the deepest tool.
    const double spoil = margins_of(kr60).spoil;
    EXPECT_EQ(blocks_needed(usable, {590, 890, 500 - 3 - spoil}), 1);
    EXPECT_EQ(blocks_needed(usable, {590, 890, 501 - 3 - spoil}), 2);
    EXPECT_EQ(blocks_needed(usable, {490, 890, 600 - 3 - spoil}), 1) << "sawn, it may stand on another side";
    EXPECT_EQ(blocks_needed(usable, {590 * 2, 890, 500 - 3 - spoil}), 2);
}

// The holder is above the block when the tip stands on the table: so high may a piece be.
TEST(BlocksNeeded, LowBlocksAreNoHigherThanTheLongestToolIsLong) {
    for (const Cell& in : cells()) {
        const std::vector<Vec3> low = low_usable_blocks(in);
        ASSERT_FALSE(low.empty()) << in.name;
        if (!in.machine) {
            EXPECT_EQ(low, usable_blocks(in)) << in.name;
            EXPECT_TRUE(std::isinf(low_piece_height(in)));
            continue;
        }
        double longest = 0;
        for (const CuttingTool& tool : in.machine->tools) {
            if (tool.shape != ToolShape::drill) longest = std::max(longest, tool.stick_out);
        }
        const Margins margins = margins_of(in);
        EXPECT_DOUBLE_EQ(low_piece_height(in), longest - margins.top - margins.spoil) << in.name;
        for (const Vec3 size : low) {
            EXPECT_LE(size.z, low_piece_height(in) + 1e-6) << in.name;
            EXPECT_EQ(blocks_needed(usable_blocks(in), size), 1) << in.name;
        }
        const Vec3 large = low.front();
        EXPECT_EQ(blocks_needed(low, large), 1) << in.name;
        EXPECT_EQ(blocks_needed(low, {large.x, large.y, 2 * low_piece_height(in)}), 2) << in.name;
    }
}

}  // namespace
}  // namespace qchopper
