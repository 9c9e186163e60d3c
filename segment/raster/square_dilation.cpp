// A square is taken along rows and then along columns; of a line, the best of each window is found by doubling windows
// in place (H. Yuan and M. J. Atallah, "Data structures for range minimum queries in multidimensional arrays", 2010).
// O(cells * log by), the memory of the result and of a line per thread.

#include "segment/raster/square_dilation.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

constexpr std::size_t lines_at_once = 64;

// Of each cell the best one within `by` in a line of cells `stride` apart, in place. `line` is room for it.
template <class Value, class Better>
void best_along(Value* first, std::size_t count, std::size_t stride, std::size_t by, Value worst, const Better& better,
                std::vector<Value>& line) {
    line.assign(count + by, worst);
    for (std::size_t i = 0; i < count; ++i) line[i + by] = first[i * stride];
    const std::size_t width = 2 * by + 1;
    for (std::size_t done = 1; done < width;) {
        const std::size_t on = std::min(done, width - done);
        for (std::size_t i = 0; i + on < line.size(); ++i) line[i] = better(line[i], line[i + on]);
        done += on;
    }
    for (std::size_t i = 0; i < count; ++i) first[i * stride] = line[i];
}

template <class Value, class Better>
std::vector<Value> best_in_square(std::vector<Value> cells, std::size_t columns, std::size_t rows, std::size_t by,
                                  Value worst, const Better& better) {
    assert(cells.size() == columns * rows);
    if (by == 0) return cells;
    const auto along = [&](std::size_t lines, std::size_t count, std::size_t beside, std::size_t stride) {
        parallel_ranges(0, lines, lines_at_once, [&](std::size_t first, std::size_t end) {
            std::vector<Value> line;
            for (std::size_t i = first; i < end; ++i) {
                best_along(&cells[i * beside], count, stride, by, worst, better, line);
            }
        });
    };
    along(rows, columns, columns, 1);
    along(columns, rows, 1, columns);
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
