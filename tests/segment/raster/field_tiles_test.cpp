#include "segment/raster/field_tiles.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace qchopper {
namespace {

constexpr std::size_t columns = 75;  // the last tile of a row is narrower
constexpr std::size_t rows = 50;

std::vector<std::size_t> cells_in(const FieldTiles& tiles) {
    std::vector<std::size_t> cells;
    for (std::size_t row = 0; row < rows; ++row) {
        std::size_t before = 0;
        bool is_first = true;
        for (const CellSpan& span : tiles.spans(row)) {
            EXPECT_LT(span.first, span.end);
            EXPECT_TRUE(is_first || span.first > before) << "spans touch";
            for (std::size_t c = span.first; c < span.end; ++c) cells.push_back(row * columns + c);
            before = span.end;
            is_first = false;
        }
    }
    return cells;
}

TEST(FieldTiles, SpansAreTheCellsThatAreHeld) {
    FieldTiles tiles(columns, rows);
    EXPECT_TRUE(tiles.is_empty());
    for (const std::size_t cell : {0, 17, 74, 20 * 75 + 30, 49 * 75 + 74}) tiles.add(cell);
    EXPECT_FALSE(tiles.is_empty());
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < columns * rows; ++i) {
        if (tiles.holds(i)) held.push_back(i);
    }
    EXPECT_EQ(cells_in(tiles), held);
    EXPECT_TRUE(tiles.holds(49 * 75 + 74));
    EXPECT_FALSE(tiles.holds(49 * 75 + 60));
}

TEST(FieldTiles, GrownHoldAllThatIsNear) {
    for (const std::size_t cells : {0U, 1U, 16U, 23U}) {
        FieldTiles tiles(columns, rows);
        tiles.add(20 * columns + 37);
        const FieldTiles wider = tiles.grown(cells);
        for (const std::size_t own : cells_in(tiles)) {
            for (std::size_t i = 0; i < columns * rows; ++i) {
                const auto apart = [&](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
                const bool is_near =
                    apart(i / columns, own / columns) <= cells && apart(i % columns, own % columns) <= cells;
                ASSERT_TRUE(!is_near || wider.holds(i)) << cells;
            }
        }
        EXPECT_LE(cells_in(wider).size(), (cells + 48) * (cells + 48) * 4);
        EXPECT_EQ(cells == 0, cells_in(wider) == cells_in(tiles));
    }
}

TEST(FieldTiles, CommonOnesAreThoseOfBoth) {
    FieldTiles one(columns, rows);
    FieldTiles other(columns, rows);
    one.add(0);
    one.add(20 * columns + 37);
    other.add(20 * columns + 37);
    other.add(40 * columns);
    const FieldTiles both = one.common(other);
    for (std::size_t i = 0; i < columns * rows; ++i) ASSERT_EQ(both.holds(i), one.holds(i) && other.holds(i)) << i;
    EXPECT_FALSE(both.is_empty());
}

}  // namespace
}  // namespace qchopper
