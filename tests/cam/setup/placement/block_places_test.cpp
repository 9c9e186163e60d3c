// Where a block of a size can stand: the map against single places, and against the search.

#include "cam/setup/placement/block_places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "base/parallel.h"
#include "cam/setup/block_placement.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

TEST(BlockPlaces, ATiltHoldsNoMorePlaces) {
    for (const char* name : {"kr60-ha.toml", "irb6640-185-2.8.toml", "gantry-3axis.toml"}) {
        const Cell cell = ready_cell(name);
        const Vec3 block{200, 300, 150};
        const BlockPlaces upright = block_places(cell, block, 0, 200);
        const BlockPlaces tilted = block_places(cell, block, 20 * degree, 200);
        ASSERT_EQ(upright.places.size(), upright.columns * upright.rows);
        ASSERT_EQ(tilted.places.size(), upright.places.size());
        std::size_t held = 0;
        for (std::size_t i = 0; i < upright.places.size(); ++i) {
            const BlockPlace& place = upright.places[i];
            EXPECT_EQ(place.is_on_table, inside_table(cell, block, {place.x, place.y, 0, {}}) >= 0) << name;
            EXPECT_TRUE(place.margin || !tilted.places[i].margin) << name;
            EXPECT_TRUE(place.is_on_table || !place.margin) << name;
            const std::optional<double> at_tilt = tilted.places[i].margin;
            EXPECT_TRUE(!at_tilt || *place.margin >= *at_tilt - 1e-6) << name;
            held += place.margin ? 1 : 0;
        }
        EXPECT_GT(held, 0U) << name;
    }
}

TEST(BlockPlaces, TheBestIsAboutAsGoodAsAnyOfTheMap) {
    const Cell cell = ready_cell("irb6640-185-2.8.toml");
    const BlockPlaces map = block_places(cell, {400, 400, 300}, 30 * degree, 100);
    ASSERT_TRUE(map.best.holds());
    const double best = map.best.tightest().relative;
    for (const BlockPlace& place : map.places) {
        EXPECT_LE(place.margin.value_or(0), best + 0.1) << place.x << ' ' << place.y;
    }
    EXPECT_TRUE(std::any_of(map.places.begin(), map.places.end(), [](const BlockPlace& p) { return !!p.margin; }));
    EXPECT_TRUE(std::any_of(map.places.begin(), map.places.end(), [](const BlockPlace& p) { return !p.margin; }));
}

TEST(BlockPlaces, AGantryTiltsNoToolAndATallBlockFitsNowhere) {
    const BlockPlaces tilted = block_places(ready_cell("gantry-3axis.toml"), {200, 200, 100}, 10 * degree, 300);
    EXPECT_FALSE(tilted.best.holds());
    const BlockPlaces tall = block_places(ready_cell("kr60-ha.toml"), {200, 200, 3000}, 0, 200);
    EXPECT_FALSE(tall.best.holds());
    for (const BlockPlace& place : tall.places) EXPECT_FALSE(place.margin);
}

TEST(BlockPlaces, AreTheSameForAnyNumberOfThreads) {
    const Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    const auto margins = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        std::vector<std::optional<double>> all;
        for (const BlockPlace& p : block_places(cell, {300, 200, 200}, 45 * degree, 250).places)
            all.push_back(p.margin);
        return all;
    };
    EXPECT_EQ(margins(1), margins(4));
}

}  // namespace
}  // namespace qchopper
