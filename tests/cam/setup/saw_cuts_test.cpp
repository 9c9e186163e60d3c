#include "cam/setup/saw_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cam/setup/block.h"

namespace qchopper {
namespace {

double volume(Vec3 size) {
    return size.x * size.y * size.z;
}

Cell some_cell(double kerf) {
    Cell cell;
    cell.stock = {{"sheet", {1000, 600, 500}, Material::pu_foam, true, kerf}};
    cell.margins = {5, 3, 10};
    return cell;
}

std::size_t flush_across(const FlushFaces& flush, std::size_t axis) {
    std::size_t faces = 0;
    for (std::size_t f = 2 * axis; f < std::min(2 * axis + 2, block_faces); ++f) faces += flush[f] ? 1 : 0;
    return faces;
}

// What the cuts leave and take, cut by cut from the whole stock.
void expect_all_of_the_stock(const std::vector<SawCuts>& cuts, const Stock& stock, Vec3 block) {
    double rest = volume(stock.size);
    Vec3 size = block;
    for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
        const int axis = static_cast<int>(cut->axis);
        EXPECT_NEAR(size[axis], cut->length, 1e-9);
        Vec3 taken = size;
        taken[axis] = cut->count * stock.kerf;
        rest -= volume(taken);
        if (cut->offcut) {
            rest -= volume(*cut->offcut);
            EXPECT_NEAR(size[axis] + taken[axis] + (*cut->offcut)[axis], cut->from, 1e-9);
        }
        size[axis] = cut->from;
    }
    EXPECT_NEAR(rest, volume(block), 1e-6 * volume(stock.size));
    EXPECT_NEAR(volume(size), volume(stock.size), 1e-6 * volume(stock.size)) << "it begins with the whole stock";
}

TEST(SawCuts, MakeEveryBlockOfItsStockGlueFacesLast) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> length(20, 400);
    std::size_t flush_blocks = 0;
    std::size_t both_ends = 0;
    for (int i = 0; i < 2000; ++i) {
        const Cell cell = some_cell(3);
        std::array<double, block_faces> caps{};
        for (double& mm2 : caps) mm2 = random() % 3 == 0 ? 5'000 : 0;
        const Vec3 piece{length(random), length(random), length(random)};
        const FlushBlock made = choose_flush_block(cell, piece, caps);
        if (!made.block.is_sawn) continue;
        const Stock& stock = cell.stock[made.block.stock];
        const std::vector<SawCuts> cuts = saw_cuts(stock, made.block.size, made.block.offcuts, made.flush);
        ASSERT_FALSE(cuts.empty()) << i;
        expect_all_of_the_stock(cuts, stock, made.block.size);
        std::vector<Vec3> offcuts;
        std::size_t last_free = 0;
        std::size_t first_flush = cuts.size();
        for (std::size_t c = 0; c < cuts.size(); ++c) {
            if (cuts[c].offcut) offcuts.push_back(*cuts[c].offcut);
            const std::size_t faces = flush_across(made.flush, cuts[c].axis);
            if (faces == 0) last_free = c + 1;
            if (faces > 0) first_flush = std::min(first_flush, c);
            EXPECT_EQ(cuts[c].count, static_cast<int>(std::max<std::size_t>(1, faces)));
            both_ends += faces > 1 ? 1 : 0;
        }
        EXPECT_LE(last_free, first_flush) << "a cut after a glue face " << i;
        std::stable_sort(offcuts.begin(), offcuts.end(), [](Vec3 a, Vec3 b) { return volume(a) > volume(b); });
        EXPECT_EQ(offcuts, made.block.offcuts);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_cut = std::any_of(cuts.begin(), cuts.end(), [&](const SawCuts& c) { return c.axis == axis; });
            EXPECT_TRUE(is_cut || flush_across(made.flush, axis) == 0) << "a glue face that is not sawn";
        }
        flush_blocks += first_flush < cuts.size() ? 1 : 0;
    }
    EXPECT_GT(flush_blocks, 500U);
    EXPECT_GT(both_ends, 100U);
}

TEST(SawCuts, OfAPieceThatTheSawAloneMakesGoThroughItsBaseToo) {
    const Cell cell = some_cell(3);
    const FlushBlock made = choose_flush_block(cell, {100, 80, 60}, {900, 900, 900, 900, 900});
    EXPECT_EQ(made.block.size, (Vec3{100, 80, 70}));
    const std::vector<SawCuts> cuts = saw_cuts(cell.stock[0], made.block.size, made.block.offcuts, made.flush, 10);
    ASSERT_EQ(cuts.size(), 3U);
    expect_all_of_the_stock(cuts, cell.stock[0], {100, 80, 60});
    for (const SawCuts& cut : cuts) EXPECT_EQ(cut.count, 2);
}

TEST(SawCuts, OfABlockThatIsNotOfThisStockAreNone) {
    const Cell cell = some_cell(3);
    const FlushBlock made = choose_flush_block(cell, {100, 80, 60}, {900, 0, 0, 0, 0});
    ASSERT_FALSE(saw_cuts(cell.stock[0], made.block.size, made.block.offcuts, made.flush).empty());
    EXPECT_TRUE(saw_cuts(some_cell(4).stock[0], made.block.size, made.block.offcuts, made.flush).empty());
    EXPECT_TRUE(
        saw_cuts(cell.stock[0], made.block.size, made.block.offcuts, {false, false, false, false, true}).empty());
    StockBlock longer = made.block;
    longer.size.x += 1;
    EXPECT_TRUE(saw_cuts(cell.stock[0], longer.size, longer.offcuts, made.flush).empty());
}

}  // namespace
}  // namespace qchopper
