// Which cells of a grid have their centres in an interval or under a triangle.
//
// Coordinates in cells from the corner of the grid; a cell's centre lies half a cell from its sides. Both ends of an
// interval belong to it. Held by tests/segment/raster/height_field_test.cpp and projected_area_test.cpp.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace qchopper {

// Cells of a row or of a column, half-open.
struct CellSpan {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Of `count` cells those whose centres lie in an interval; none if it is empty.
inline CellSpan centres_within(double low, double high, std::size_t count) {
    const auto within = [count](double at) {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count)));
    };
    const std::size_t first = within(std::ceil(low - 0.5));
    return {first, std::max(first, within(std::floor(high - 0.5) + 1))};
}

// Calls visit(row, cells) for each row of a grid in which the triangle covers centres of cells. Corners have an x and a
// y. A row through a corner meets two edges or none (the half-open rule of line_crossing.h). O(rows covered).
template <class Corner, class Visit>
void for_each_row_under(const std::array<Corner, 3>& corner, std::size_t columns, std::size_t rows,
                        const Visit& visit) {
    const CellSpan covered = centres_within(std::min({corner[0].y, corner[1].y, corner[2].y}),
                                            std::max({corner[0].y, corner[1].y, corner[2].y}), rows);
    for (std::size_t row = covered.first; row < covered.end; ++row) {
        const double y = static_cast<double>(row) + 0.5;
        double from = std::numeric_limits<double>::infinity();
        double to = -from;
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner& a = corner[k];
            const Corner& b = corner[(k + 1) % 3];
            if ((a.y <= y) == (b.y <= y)) continue;
            const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        if (from <= to) visit(row, centres_within(from, to, columns));
    }
}

}  // namespace qchopper
