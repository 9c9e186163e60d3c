// A square is grown along rows and then along columns: a cell is in it if the nearest marked one before or behind is
// near enough. O(cells).

#include "cam/stock/cl_surface_view.h"

#include "base/parallel.h"

namespace qchopper {
namespace {

// A line of `count` cells, `stride` apart.
void grow_line(std::uint8_t* first, std::size_t count, std::size_t stride, std::size_t by) {
    std::vector<std::uint8_t> was(count);
    for (std::size_t i = 0; i < count; ++i) was[i] = first[i * stride];
    std::size_t since = by + 1;
    for (std::size_t i = 0; i < count; ++i) {
        since = was[i] != 0 ? 0 : since + 1;
        if (since <= by) first[i * stride] = 1;
    }
    since = by + 1;
    for (std::size_t i = count; i-- > 0;) {
        since = was[i] != 0 ? 0 : since + 1;
        if (since <= by) first[i * stride] = 1;
    }
}

}  // namespace

CellMask dilated(const CellMask& mask, std::size_t columns, std::size_t rows, std::size_t by) {
    CellMask result = mask;
    if (by == 0) return result;
    parallel_for(0, rows, [&](std::size_t row) { grow_line(&result[row * columns], columns, 1, by); });
    parallel_ranges(0, columns, 64, [&](std::size_t first, std::size_t end) {
        for (std::size_t c = first; c < end; ++c) grow_line(&result[c], rows, columns, by);
    });
    return result;
}

}  // namespace qchopper
