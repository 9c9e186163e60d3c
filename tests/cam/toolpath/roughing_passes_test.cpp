// Passes of a level of roughing against a plain loop over cells.

#include "cam/toolpath/roughing_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "segment/raster/disc_dilation.h"
#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

using test_pieces::random_map;

LevelRegion random_region(unsigned seed) {
    std::mt19937 random(seed);
    LevelRegion region{1.5, 60, 45, {}, {}};
    const HeightField noise = dilate_by_disc(random_map(60, 45, 1, seed), 2.3);
    for (const float height : noise.height) region.is_allowed.push_back(height < 47.5F ? 1 : 0);
    region.is_wanted.assign(region.is_allowed.size(), 1);
    for (std::size_t i = 0; i < 600; ++i) region.is_wanted[i] = 0;
    return region;
}

// Within an eighth of a cell, by which a line may pass the corner of another cell, or so far from the middle of one.
bool is_allowed_near(const LevelRegion& region, Vec3 p) {
    for (const double x : {-0.126, 0.126}) {
        for (const double y : {-0.126, 0.126}) {
            if (region.allowed(std::lround(p.x / 1.5 - 0.5 + x), std::lround(p.y / 1.5 - 0.5 + y))) return true;
        }
    }
    // Of the way over neighbouring cells no place is farther from the middle of one than half a cell.
    for (std::size_t i = 0; i < region.is_allowed.size(); ++i) {
        const std::size_t row = i / region.columns;
        const double x = 1.5 * (static_cast<double>(i % region.columns) + 0.5) - p.x;
        const double y = 1.5 * (static_cast<double>(row) + 0.5) - p.y;
        if (region.is_allowed[i] != 0 && std::hypot(x, y) <= region.beside + 0.75) return true;
    }
    return false;
}

TEST(RoughingPasses, StayInTheRegionAndReachAllOfIt) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        LevelRegion region = random_region(seed);
        region.beside = seed % 2 == 0 ? 0 : 0.6;
        const double step = 6;
        std::vector<Vec3> places;
        for (const Pass& pass : roughing_passes(region, 4.5, step)) {
            ASSERT_GE(pass.points.size(), 2U);
            for (std::size_t i = 1; i < pass.points.size(); ++i) {
                const Vec3 from = pass.points[i - 1].tip;
                const Vec3 way = pass.points[i].tip - from;
                for (int k = 0; k <= 100; ++k) {
                    const Vec3 p = from + (k / 100.0) * way;
                    ASSERT_EQ(p.z, 4.5);
                    ASSERT_TRUE(is_allowed_near(region, p)) << p.x << " " << p.y;
                    places.push_back(p);
                }
            }
        }
        for (std::size_t i = 0; i < region.is_allowed.size(); ++i) {
            const auto column = static_cast<std::ptrdiff_t>(i % 60);
            const auto row = static_cast<std::ptrdiff_t>(i / 60);
            // A cell alone has no way that is longer than nothing.
            const bool is_joined = region.wanted(column - 1, row) || region.wanted(column + 1, row);
            if (!region.wanted(column, row) || !is_joined) continue;
            double least = 1e9;
            for (const Vec3& p : places) {
                least = std::min(least, std::hypot(p.x - 1.5 * (static_cast<double>(column) + 0.5),
                                                   p.y - 1.5 * (static_cast<double>(row) + 0.5)));
            }
            EXPECT_LE(least, 0.5 * step + 1.5) << seed << ": " << column << " " << row;
        }
    }
}

TEST(RoughingPasses, RowsLieAlongTheAxisThatHasFewer) {
    for (const bool is_wide : {true, false}) {
        LevelRegion region{1, is_wide ? 90U : 30U, is_wide ? 30U : 90U, {}, {}};
        region.is_allowed.assign(2700, 1);
        region.is_wanted = region.is_allowed;
        std::size_t rows = 0;
        for (const Pass& pass : roughing_passes(region, 0, 5)) {
            if (pass.is_closed) continue;
            ++rows;
            const Vec3 along = pass.points.back().tip - pass.points.front().tip;
            EXPECT_EQ(is_wide ? along.y : along.x, 0);
            EXPECT_EQ(is_wide ? along.x : along.y, 89);
        }
        EXPECT_EQ(rows, 6U);
    }
}

}  // namespace
}  // namespace qchopper
