// A line is followed through the cells of a map from border to border (J. Amanatides, A. Woo: A Fast Voxel Traversal
// Algorithm for Ray Tracing, 1987) of tiles that do not exist, else of cells; in a cell the height of the line is
// linear, so that where it leaves the removed part is solved, not sampled. O(cells along the line).

#include "sim/replay/stock/dexel_map.h"

#include <algorithm>
#include <cmath>

#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double border = 1;  // cells around the projection of the block

// Takes a part from one of the intervals, which holds all of it; `at` is then the one that holds what follows it.
void subtract(std::vector<Dexel>& intervals, std::size_t& at, double low, double high) {
    if (!(low < high)) return;
    Dexel& own = intervals[at];
    const Dexel above{high, own.high};
    own.high = low;
    const bool has_below = own.low < own.high;
    const auto next = intervals.begin() + static_cast<std::ptrdiff_t>(at);
    if (above.low < above.high && has_below) {
        intervals.insert(next + 1, above);
        ++at;
    } else if (above.low < above.high) {
        own = above;
    } else if (!has_below) {
        intervals.erase(next);
    }
}

}  // namespace

void DexelTile::measure_most() {
    if (lowered_squares == 0) return;
    constexpr std::size_t per_row = side / square;
    for (std::size_t in = 0; in < max_of_square.size(); ++in) {
        if ((lowered_squares >> in & 1) == 0) continue;
        const float* row = &cut[in / per_row * square * side + in % per_row * square];
        float most = -std::numeric_limits<float>::infinity();
        for (std::int32_t j = 0; j < square; ++j, row += side) {
            for (std::int32_t i = 0; i < square; ++i) most = row[i] > most ? row[i] : most;
        }
        max_of_square[in] = most;
    }
    lowered_squares = 0;
    max_cut = *std::max_element(max_of_square.begin(), max_of_square.end());
}

// In lanes, which compilers turn into vectors.
float DexelTile::highest_in(std::size_t first, std::int32_t size) const {
    std::array<float, square> highest;
    highest.fill(-std::numeric_limits<float>::infinity());
    for (std::int32_t j = 0; j < size; ++j) {
        for (std::int32_t i = 0; i < size; i += square) {
            const std::size_t begin = first + static_cast<std::size_t>(j) * side + static_cast<std::size_t>(i);
            for (std::size_t k = 0; k < highest.size(); ++k) {
                const float own = low[begin + k] < high[begin + k] ? high[begin + k] : highest[k];
                highest[k] = own > highest[k] ? own : highest[k];
            }
        }
    }
    return *std::max_element(highest.begin(), highest.end());
}

DexelMap::DexelMap(const Box& block_box, Vec3 tool_axis, double cell)
    : frame_in_block(tool_axis_frame(tool_axis)), block(block_box), cell_(cell) {
    Box bounds;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1) != 0 ? block.max.x : block.min.x, (corner & 2) != 0 ? block.max.y : block.min.y,
                     (corner & 4) != 0 ? block.max.z : block.min.z};
        const Vec3 q = apply_inverse(frame_in_block, p);
        if (corner == 0) bounds = {q, q};
        extend(bounds, q);
    }
    top = bounds.max.z;
    bottom = bounds.min.z;
    // Middles of cells lie on multiples of the cell plus a half, whatever the block is.
    x_min_ = (std::floor(bounds.min.x / cell) - border) * cell;
    y_min_ = (std::floor(bounds.min.y / cell) - border) * cell;
    const auto tiles = [&](double min, double max) {
        return static_cast<std::int32_t>(std::ceil((max - min) / cell + border)) / DexelTile::side + 1;
    };
    tiles_x_ = tiles(x_min_, bounds.max.x);
    tiles_y_ = tiles(y_min_, bounds.max.y);
    tiles_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
}

CellRange DexelMap::range(double x_min, double x_max, double y_min, double y_max) const {
    const auto first = [&](double at, double begin, std::int32_t tiles) {
        const double i = std::ceil((at - begin) / cell_ - 0.5);
        return static_cast<std::int32_t>(std::clamp(i, 0.0, static_cast<double>(tiles) * DexelTile::side));
    };
    CellRange cells{first(x_min, x_min_, tiles_x_), first(x_max, x_min_, tiles_x_) + 1, first(y_min, y_min_, tiles_y_),
                    first(y_max, y_min_, tiles_y_) + 1};
    cells.x_end = std::min(cells.x_end, tiles_x_ * DexelTile::side);
    cells.y_end = std::min(cells.y_end, tiles_y_ * DexelTile::side);
    return cells;
}

DexelTile& DexelMap::made_tile(std::int32_t tx, std::int32_t ty) {
    std::unique_ptr<DexelTile>& tile = tiles_[index(tx, ty)];
    if (!tile) tile = std::make_unique<DexelTile>();
    return *tile;
}

float DexelMap::cut_at(double x, double y) const {
    const double i = std::floor((x - x_min_) / cell_);
    const double j = std::floor((y - y_min_) / cell_);
    constexpr auto side = DexelTile::side;
    if (!(i >= 0 && j >= 0 && i < double(tiles_x_) * side && j < double(tiles_y_) * side)) return infinite;
    const auto ci = static_cast<std::int32_t>(i);
    const auto cj = static_cast<std::int32_t>(j);
    const DexelTile* tile = this->tile(ci / side, cj / side);
    if (tile == nullptr) return std::numeric_limits<float>::infinity();
    return tile->cut[static_cast<std::size_t>(cj % side) * side + static_cast<std::size_t>(ci % side)];
}

Dexel DexelMap::block_on(Vec3 from, Vec3 along) const {
    const Vec3 p = apply(frame_in_block, from);
    const Vec3 d = rotate(frame_in_block, along);
    Dexel inside{-infinite, infinite};
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(d[axis]) < 1e-12) {
            if (p[axis] < block.min[axis] || p[axis] > block.max[axis]) return {0, 0};
            continue;
        }
        const double a = (block.min[axis] - p[axis]) / d[axis];
        const double b = (block.max[axis] - p[axis]) / d[axis];
        inside.low = std::max(inside.low, std::min(a, b));
        inside.high = std::min(inside.high, std::max(a, b));
    }
    return inside.low < inside.high ? inside : Dexel{0, 0};
}

// Squares that the line passes below all that was cut there, or through air alone, are passed at once: tiles, then
// their squares, then cells; so are the gaps between intervals.
void DexelMap::remove_from(std::vector<Dexel>& intervals, const MapLine& line, const Dexel& within) const {
    constexpr auto side = DexelTile::side;
    const double nudge = 1e-9 * cell_;
    const double per_cell = 1 / cell_;
    const double columns = double(tiles_x_) * side;
    const double rows = double(tiles_y_) * side;
    std::size_t interval = 0;
    double t = within.low;
    while (true) {
        while (interval < intervals.size() && intervals[interval].high <= t) ++interval;
        if (interval == intervals.size()) return;
        t = std::max(t, intervals[interval].low);
        const double end = std::min(intervals[interval].high, within.high);
        if (t >= end) return;
        const double middle = t + nudge;
        const double i = (line.from.x + middle * line.along.x - x_min_) * per_cell;
        const double j = (line.from.y + middle * line.along.y - y_min_) * per_cell;
        if (!(i >= 0 && j >= 0 && i < columns && j < rows)) return;
        const auto ci = static_cast<std::int32_t>(i);
        const auto cj = static_cast<std::int32_t>(j);
        const DexelTile* here = tile(ci / side, cj / side);
        double next = leaves_square(line, ci, cj, side, middle, end);
        if (here != nullptr && here->min_cut < line.highest(t, next)) {
            if (here->max_cut < line.lowest(t, next)) {
                subtract(intervals, interval, t, next);
            } else {
                next = remove_in_square(intervals, interval, line, *here, {ci, cj}, {t, end});
            }
        }
        t = next;
    }
}

// Returns where the part of the line that was done ends: in the square, cell by cell, unless it is passed at once.
double DexelMap::remove_in_square(std::vector<Dexel>& intervals, std::size_t& interval, const MapLine& line,
                                  const DexelTile& here, MapCell at, const Dexel& part) const {
    constexpr auto side = DexelTile::side;
    const double nudge = 1e-9 * cell_;
    const double per_cell = 1 / cell_;
    double t = part.low;
    const std::size_t square = DexelTile::square_of_cut(at.i % side, at.j % side);
    const double left = leaves_square(line, at.i, at.j, DexelTile::square, t + nudge, part.high);
    if (here.min_of_square[square] >= line.highest(t, left)) return left;
    if (here.max_of_square[square] < line.lowest(t, left)) {
        subtract(intervals, interval, t, left);
        return left;
    }
    MapCell cell = at;
    while (true) {
        const double next = leaves_square(line, cell.i, cell.j, 1, t + nudge, part.high);
        const double cut =
            here.cut[static_cast<std::size_t>(cell.j % side) * side + static_cast<std::size_t>(cell.i % side)];
        const double crossing = line.along.z != 0 ? (cut - line.from.z) * line.per_z : infinite;
        if (line.along.z > 0) subtract(intervals, interval, std::max(t, crossing), next);
        if (line.along.z < 0) subtract(intervals, interval, t, std::min(next, crossing));
        if (line.along.z == 0 && line.from.z > cut) subtract(intervals, interval, t, next);
        if (next >= left) return next;
        t = next;
        const double i = (line.from.x + (t + nudge) * line.along.x - x_min_) * per_cell;
        const double j = (line.from.y + (t + nudge) * line.along.y - y_min_) * per_cell;
        if (!(i >= 0 && j >= 0)) return next;
        cell = {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
        const bool is_in = cell.i / DexelTile::square == at.i / DexelTile::square &&
                           cell.j / DexelTile::square == at.j / DexelTile::square;
        if (!is_in) return next;
    }
}

DexelMap::Removed DexelMap::removed_in(const Dexel& heights, const MapRectangle& within) const {
    constexpr std::int32_t squares = DexelTile::side / DexelTile::square;  // of a tile, each way
    const auto square_of = [&](double at, double begin, std::int32_t tiles) {
        const double square = (at - begin) / cell_ / DexelTile::square;
        return static_cast<std::int32_t>(std::clamp(square, 0.0, static_cast<double>(tiles * squares - 1)));
    };
    const std::int32_t i_begin = square_of(within.x_min, x_min_, tiles_x_);
    const std::int32_t i_end = square_of(within.x_max, x_min_, tiles_x_);
    const std::int32_t j_end = square_of(within.y_max, y_min_, tiles_y_);
    bool is_some = false;
    bool is_all = true;
    for (std::int32_t j = square_of(within.y_min, y_min_, tiles_y_); j <= j_end; ++j) {
        for (std::int32_t i = i_begin; i <= i_end; ++i) {
            const DexelTile* here = tile(i / squares, j / squares);
            if (here != nullptr) {
                const auto in_tile =
                    static_cast<std::size_t>(j % squares) * squares + static_cast<std::size_t>(i % squares);
                is_some |= static_cast<double>(here->min_of_square[in_tile]) < heights.high;
                is_all &= static_cast<double>(here->max_of_square[in_tile]) < heights.low;
            } else {
                is_all = false;
            }
            if (is_some && !is_all) return Removed::some;
        }
    }
    return is_some ? Removed::all : Removed::none;
}

double DexelMap::distance_to_removed(Vec3 point, double most) const {
    constexpr auto side = DexelTile::side;
    const bool is_within_few_squares = most <= DexelTile::square * cell_;
    const MapRectangle about{point.x - most, point.x + most, point.y - most, point.y + most};
    const Dexel height{point.z + most, point.z + most};
    if (is_within_few_squares && removed_in(height, about) == Removed::none) return most;
    return distance_to_cells(point, x_min_, y_min_, cell_, most, [&](std::int32_t i, std::int32_t j) {
        const bool is_in = i >= 0 && j >= 0 && i < tiles_x_ * side && j < tiles_y_ * side;
        const DexelTile* here = is_in ? tile(i / side, j / side) : nullptr;
        if (here == nullptr) return std::numeric_limits<float>::infinity();
        return here->cut[static_cast<std::size_t>(j % side) * side + static_cast<std::size_t>(i % side)];
    });
}

}  // namespace qchopper
