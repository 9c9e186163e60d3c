// Dilation and erosion against the plain definition, bit for bit, whole and of some cells.

#include "sim/replay/reach/cutter_morphology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/parallel.h"

namespace qchopper {
namespace {

// Noise over a slope, with a step, and cells without surface.
SurfaceMap rough_map(std::int32_t columns, std::int32_t rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> noise(0, 1);
    SurfaceMap map;
    map.cell = 0.5;
    map.columns = columns;
    map.rows = rows;
    for (std::int32_t j = 0; j < rows; ++j) {
        for (std::int32_t i = 0; i < columns; ++i) {
            const float slope = 0.3F * static_cast<float>(i) + (j > rows / 2 ? 20.0F : 0.0F);
            map.height.push_back(noise(random) < 0.02F ? no_surface : slope + noise(random));
        }
    }
    return map;
}

// sign 1: dilation; -1: erosion.
std::vector<float> by_definition(const SurfaceMap& map, const Cutter& cutter, float sign) {
    const auto most = static_cast<std::int32_t>(cutter.radius / map.cell);
    std::vector<float> result;
    for (std::int32_t j = 0; j < map.rows; ++j) {
        for (std::int32_t i = 0; i < map.columns; ++i) {
            float best = no_surface;
            for (std::int32_t dy = -most; dy <= most; ++dy) {
                for (std::int32_t dx = -most; dx <= most; ++dx) {
                    const double r = map.cell * std::sqrt(static_cast<double>(dx * dx + dy * dy));
                    const bool is_in = i + dx >= 0 && i + dx < map.columns && j + dy >= 0 && j + dy < map.rows;
                    if (r > cutter.radius || !is_in) continue;
                    const float height = map.height[static_cast<std::size_t>(j + dy) * map.columns + i + dx];
                    best = std::max(best, sign * height - static_cast<float>(profile_height(cutter, r)));
                }
            }
            result.push_back(sign * best);
        }
    }
    return result;
}

const Cutter ball{ToolShape::ball, 6, 6, 0, 1};
const Cutter flat{ToolShape::flat, 11, 0, 0, 1};

TEST(CutterMorphology, EqualsTheDefinition) {
    for (const auto& [columns, rows] : {std::pair{1, 1}, std::pair{63, 5}, std::pair{64, 16}, std::pair{150, 70}}) {
        const SurfaceMap map = rough_map(columns, rows, 3);
        const CellBlocks all = CellBlocks::all_of(map);
        for (const Cutter& cutter : {ball, flat}) {
            EXPECT_EQ(dilated(map, cutter, all), by_definition(map, cutter, 1)) << columns << " x " << rows;
            EXPECT_EQ(eroded(map, cutter, all), by_definition(map, cutter, -1)) << columns << " x " << rows;
        }
    }
}

TEST(CutterMorphology, OfSomeCellsTheSame) {
    const SurfaceMap map = rough_map(150, 70, 5);
    CellBlocks some(map);
    some.add({-20, 3, 10, 12});
    some.add({140, 400, 60, 90});
    some.add({500, 600, 0, 10});  // beyond the map
    const std::vector<float> whole = dilated(map, ball, CellBlocks::all_of(map));
    const std::vector<float> part = dilated(map, ball, some);
    std::size_t asked = 0;
    for (std::int32_t j = 0; j < map.rows; ++j) {
        for (std::int32_t i = 0; i < map.columns; ++i) {
            const std::size_t cell = static_cast<std::size_t>(j) * map.columns + i;
            ASSERT_EQ(part[cell], some.has(i, j) ? whole[cell] : no_surface) << i << " " << j;
            asked += some.has(i, j) ? 1 : 0;
        }
    }
    EXPECT_GE(asked, 3U * 2 + 10U * 10);
    EXPECT_LT(asked, whole.size() / 2);
}

TEST(CutterMorphology, GrownBlocksHoldAllThatIsSoNear) {
    const SurfaceMap map = rough_map(300, 100, 7);
    CellBlocks few(map);
    few.add({130, 131, 40, 41});
    const CellBlocks wide = few.grown(20);
    for (std::int32_t j = 0; j < map.rows; ++j) {
        for (std::int32_t i = 0; i < map.columns; ++i) {
            bool is_near = false;
            for (std::int32_t b = std::max(0, j - 20); b <= std::min(map.rows - 1, j + 20); ++b) {
                for (std::int32_t a = std::max(0, i - 20); a <= std::min(map.columns - 1, i + 20); ++a) {
                    is_near = is_near || few.has(a, b);
                }
            }
            ASSERT_TRUE(wide.has(i, j) || !is_near) << i << " " << j;
        }
    }
    EXPECT_FALSE(wide.has(0, 0));
    EXPECT_FALSE(wide.has(299, 99));
}

TEST(CutterMorphology, DoesNotDependOnThreads) {
    const SurfaceMap map = rough_map(150, 70, 9);
    const std::vector<float> many = eroded(map, ball, CellBlocks::all_of(map));
    const ThreadLimit one(1);
    EXPECT_EQ(eroded(map, ball, CellBlocks::all_of(map)), many);
}

}  // namespace
}  // namespace qchopper
