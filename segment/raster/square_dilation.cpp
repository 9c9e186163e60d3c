// A square is taken along rows and then along columns; of a line, the best of each window is found by doubling windows
// in place (H. Yuan and M. J. Atallah, "Data structures for range minimum queries in multidimensional arrays", 2010).
// Columns are taken several at once. O(cells * log by), the memory of the result and of some lines per thread.

#include "segment/raster/square_dilation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

constexpr std::size_t rows_at_once = 64;
constexpr std::size_t lanes = 16;  // lines side by side, of which the same is computed at once

template <class Value>
using Lanes = std::array<Value, lanes>;

// Of each place the best one within `by` of it in a line of `count`, for lines that are given side by side. `line`
// holds `by` places that are `worst`, and after them those of the line; the result begins at its first place.
template <class Place, class Better>
void best_along(std::vector<Place>& line, std::size_t by, const Better& better) {
    const std::size_t width = 2 * by + 1;
    for (std::size_t done = 1; done < width;) {
        const std::size_t on = std::min(done, width - done);
        for (std::size_t i = 0; i + on < line.size(); ++i) better(line[i], line[i + on]);
        done += on;
    }
}

template <class Value, class Better>
std::vector<Value> best_in_square(std::vector<Value> cells, std::size_t columns, std::size_t rows, std::size_t by,
                                  Value worst, const Better& better) {
    assert(cells.size() == columns * rows);
    if (by == 0) return cells;
    parallel_ranges(0, rows, rows_at_once, [&](std::size_t first, std::size_t end) {
        std::vector<Value> line;
        for (std::size_t row = first; row < end; ++row) {
            Value* own = &cells[row * columns];
            if (std::all_of(own, own + columns, [worst](Value value) { return value == worst; })) continue;
            line.assign(by, worst);
            line.insert(line.end(), own, own + columns);
            best_along(line, by, [&](Value& to, Value other) { to = better(to, other); });
            std::copy_n(line.begin(), columns, own);
        }
    });
    parallel_for(0, (columns + lanes - 1) / lanes, [&](std::size_t group) {
        const std::size_t first = group * lanes;
        const std::size_t count = std::min(lanes, columns - first);
        Lanes<Value> none;
        none.fill(worst);
        std::vector<Lanes<Value>> line(by + rows, none);
        for (std::size_t row = 0; row < rows; ++row) {
            std::copy_n(&cells[row * columns + first], count, line[by + row].begin());
        }
        best_along(line, by, [&](Lanes<Value>& to, const Lanes<Value>& other) {
            for (std::size_t k = 0; k < lanes; ++k) to[k] = better(to[k], other[k]);
        });
        for (std::size_t row = 0; row < rows; ++row) {
            std::copy_n(line[row].begin(), count, &cells[row * columns + first]);
        }
    });
    return cells;
}

}  // namespace

CellMask dilate_by_square(CellMask mask, std::size_t columns, std::size_t rows, std::size_t by) {
    return best_in_square(std::move(mask), columns, rows, by, std::uint8_t{0},
                          [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
}

std::vector<float> erode_by_square(std::vector<float> heights, std::size_t columns, std::size_t rows, std::size_t by) {
    return best_in_square(std::move(heights), columns, rows, by, std::numeric_limits<float>::infinity(),
                          [](float a, float b) { return std::min(a, b); });
}

}  // namespace qchopper
