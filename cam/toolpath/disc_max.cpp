// Row by row of the disc: each is a window of some width, and the largest value in it is the larger of those in two
// windows of a power of two that cover it (H. Yuan and M. J. Atallah, "Data structures for range minimum queries in
// multidimensional arrays", 2010). The windows of one row of the map are doubled in place, and are used for all rows of
// the disc of that size before the next doubling.

#include "cam/toolpath/disc_max.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace qchopper {
namespace {

struct DiscRow {
    std::ptrdiff_t row = 0;
    std::size_t half = 0;  // cells on each side of the middle
};

// By the largest power of two that fits into the row.
std::vector<std::vector<DiscRow>> disc_rows(double cells) {
    const auto reach = static_cast<std::ptrdiff_t>(cells);
    std::vector<std::vector<DiscRow>> rows(
        static_cast<std::size_t>(std::bit_width(2 * static_cast<unsigned>(reach) + 1)));
    for (std::ptrdiff_t row = -reach; row <= reach; ++row) {
        const auto across = static_cast<double>(row);
        const auto half = static_cast<std::size_t>(std::sqrt(std::max(0.0, cells * cells - across * across)));
        rows[static_cast<std::size_t>(std::bit_width(2 * half + 1)) - 1].push_back({row, half});
    }
    return rows;
}

}  // namespace

HeightMap disc_max(const HeightMap& map, double radius) {
    assert(radius >= 0);
    const double cells = radius / map.cell;
    const auto reach = static_cast<std::size_t>(cells);
    const std::vector<std::vector<DiscRow>> by_level = disc_rows(cells);
    const std::size_t columns = map.columns + 2 * reach;
    std::vector<float> window(columns * map.rows, HeightMap::nothing);
    for (std::size_t row = 0; row < map.rows; ++row) {
        std::copy_n(&map.height[row * map.columns], map.columns, &window[row * columns + reach]);
    }
    HeightMap highest = map;
    for (std::size_t level = 0; level < by_level.size(); ++level) {
        const std::size_t width = std::size_t{1} << level;
        parallel_for(0, map.rows, [&](std::size_t row) {
            float* own = &highest.height[row * map.columns];
            for (const DiscRow& part : by_level[level]) {
                const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(row) + part.row;
                if (from < 0 || from >= static_cast<std::ptrdiff_t>(map.rows)) continue;
                const float* first = &window[static_cast<std::size_t>(from) * columns + reach - part.half];
                const float* last = first + (2 * part.half + 1 - width);
                for (std::size_t c = 0; c < map.columns; ++c) own[c] = std::max({own[c], first[c], last[c]});
            }
        });
        parallel_for(0, map.rows, [&](std::size_t row) {
            float* own = &window[row * columns];
            for (std::size_t c = 0; c + width < columns; ++c) own[c] = std::max(own[c], own[c + width]);
        });
    }
    return highest;
}

float disc_max_at(const HeightMap& map, double x, double y, double radius) {
    const double column = x / map.cell - 0.5;
    const double row = y / map.cell - 0.5;
    const double cells = radius / map.cell;
    const auto within = [](double value, std::size_t count) {
        return static_cast<std::ptrdiff_t>(std::clamp(value, -1.0, static_cast<double>(count)));
    };
    float highest = HeightMap::nothing;
    const auto take = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
        if (c < 0 || r < 0 || std::cmp_greater_equal(c, map.columns) || std::cmp_greater_equal(r, map.rows)) return;
        highest = std::max(highest, map.at(static_cast<std::size_t>(c), static_cast<std::size_t>(r)));
    };
    take(within(std::round(column), map.columns), within(std::round(row), map.rows));
    const std::ptrdiff_t last_row = within(std::floor(row + cells), map.rows);
    for (std::ptrdiff_t r = within(std::ceil(row - cells), map.rows); r <= last_row; ++r) {
        const double across = static_cast<double>(r) - row;
        const double half = std::sqrt(std::max(0.0, cells * cells - across * across));
        const std::ptrdiff_t last = within(std::floor(column + half), map.columns);
        for (std::ptrdiff_t c = within(std::ceil(column - half), map.columns); c <= last; ++c) take(c, r);
    }
    return highest;
}

}  // namespace qchopper
