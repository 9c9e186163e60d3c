// One map per orientation, closed by a disc, the underside of a flat end: the highest of the cells under it where it
// stands, and of a cell the lowest of the discs over it. Then each is lowered to the lowest of nine cells.
// O(cells * radius / cell) an orientation.

#include "cam/setup/placement/foam_left.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

// Of each cell the lowest of it and those beside it, along rows and then along columns. A cell with nothing counts as
// one that the tool has not come to.
void lower_to_neighbours(HeightField& map) {
    for (float& height : map.height) {
        if (height == HeightField::nothing) height = std::numeric_limits<float>::infinity();
    }
    std::vector<float> before = map.height;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::size_t column = i % map.columns;
        if (column > 0) map.height[i] = std::min(map.height[i], before[i - 1]);
        if (column + 1 < map.columns) map.height[i] = std::min(map.height[i], before[i + 1]);
    }
    before = map.height;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (i >= map.columns) map.height[i] = std::min(map.height[i], before[i - map.columns]);
        if (i + map.columns < before.size()) map.height[i] = std::min(map.height[i], before[i + map.columns]);
    }
}

// The map with so many more cells on all sides, in which there is nothing.
HeightField widened(const HeightField& map, std::size_t cells) {
    HeightField wide{map.piece_in_field, map.cell, map.columns + 2 * cells, map.rows + 2 * cells, {}};
    wide.height.assign(wide.columns * wide.rows, HeightField::nothing);
    for (std::size_t row = 0; row < map.rows; ++row) {
        const auto from = map.height.begin() + static_cast<std::ptrdiff_t>(row * map.columns);
        const auto to = wide.height.begin() + static_cast<std::ptrdiff_t>((row + cells) * wide.columns + cells);
        std::copy(from, from + static_cast<std::ptrdiff_t>(map.columns), to);
    }
    return wide;
}

void negate(HeightField& map) {
    for (float& height : map.height) height = -height;
}

// Where the tool stands beside all of the surface it goes down without end.
void close_by_disc(HeightField& map, double radius) {
    const auto border = static_cast<std::size_t>(std::ceil(radius / map.cell)) + 1;
    HeightField tip = dilate_by_disc(widened(map, border), radius);
    negate(tip);
    HeightField closed = dilate_by_disc(tip, radius);
    negate(closed);
    for (std::size_t row = 0; row < map.rows; ++row) {
        for (std::size_t column = 0; column < map.columns; ++column) {
            float& own = map.height[row * map.columns + column];
            if (own != HeightField::nothing) own = std::max(own, closed.at(column + border, row + border));
        }
    }
}

}  // namespace

void FoamLeft::remove_above(HeightField surface, bool clears_beside) {
    close_by_disc(surface, tool_radius_);
    lower_to_neighbours(surface);
    const Pose setup_in_field = surface.piece_in_field * setup_in_piece_;
    removed_.push_back({setup_in_field, std::move(surface), clears_beside});
}

bool FoamLeft::stands_at(Vec3 point) const {
    return std::none_of(removed_.begin(), removed_.end(), [&](const Removed& r) {
        const Vec3 p = apply(r.setup_in_field, point);
        const std::optional<std::size_t> cell = r.cl.cell_under(p.x, p.y);
        return cell ? static_cast<double>(r.cl.height[*cell]) <= p.z : r.clears_beside;
    });
}

}  // namespace qchopper
